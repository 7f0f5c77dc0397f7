# Tests what scripts/package and scripts/release print before they build anything, and the bill of materials of a
# release.
source "$(dirname "$0")/check.bash"
scripts=$source_folder/scripts

expect_exit 0 "$scripts/package" --help
for kind in "$scripts"/lib/package_*.bash; do
  kind=${kind##*/package_}
  grep -qE "^  ${kind%.bash} " "$work/output" || fail "scripts/package --help does not name ${kind%.bash}"
done
expect_exit 0 "$scripts/package" deb --help
expect_output "Usage: scripts/package deb [--test]"
expect_exit 2 "$scripts/package"
expect_output "KIND is missing; try --help"
expect_exit 2 "$scripts/package" rpm
expect_output "unknown kind 'rpm'; try --help"
expect_exit 2 "$scripts/package" deb --tset
expect_output "unknown argument '--tset'; try --help"
expect_exit 0 "$scripts/release" --help
expect_exit 2 "$scripts/release" --chek
expect_output "unknown option '--chek'; try --help"
expect_exit 2 "$scripts/release" rpm
expect_output "unknown kind 'rpm'; try scripts/package --help"

# These packages look as their tools write them, but have no contents.
mkdir -p "$work/release" "$work/npm/package" "$work/wheel/texremap-0.1.0.dist-info"
echo sources >"$work/release/remap-0.1.0.tar.gz"
echo '{"dependencies": {"fast-png": "^8.0.0", "@gltf-transform/core": "^4.5.1"}}' >"$work/npm/package/package.json"
tar -C "$work/npm" -czf "$work/release/texremap-0.1.0.tgz" package
printf '%s\n' "Name: texremap" "Requires-Dist: numpy" "Requires-Dist: openimageio >=3; extra == 'images'" \
  >"$work/wheel/texremap-0.1.0.dist-info/METADATA"
python3 -c "import shutil; shutil.make_archive('$work/wheel', 'zip', '$work/wheel')"
mv "$work/wheel.zip" "$work/release/texremap-0.1.0-cp312-abi3-linux_x86_64.whl"
bill() { SOURCE_DATE_EPOCH=1700000000 python3 "$scripts/lib/sbom.py" 0.1.0 "$work/release"; }
expect_exit 0 bill
cp "$work/output" "$work/bill.json"
python3 - "$work/bill.json" <<'PROGRAM' || fail "the bill is wrong: $(cat "$work/bill.json")"
import json, sys
bill = json.load(open(sys.argv[1]))
assert bill["spdxVersion"] == "SPDX-2.3" and bill["creationInfo"]["created"] == "2023-11-14T22:13:20Z"
known = {package["SPDXID"] for package in bill["packages"]} | {"SPDXRef-DOCUMENT"}
links = {(link["spdxElementId"], link["relationshipType"], link["relatedSpdxElement"]) for link in bill["relationships"]}
assert all(one in known and other in known for one, _, other in links)
npm, wheel = "SPDXRef-file-texremap-0.1.0.tgz", "SPDXRef-file-texremap-0.1.0-cp312-abi3-linux-x86-64.whl"
assert (npm, "DEPENDS_ON", "SPDXRef-npm-fast-png") in links and (npm, "DEPENDS_ON", "SPDXRef-npm--gltf-transform-core") in links
assert (wheel, "DEPENDS_ON", "SPDXRef-pypi-numpy") in links and not any("openimageio" in other for _, _, other in links)
places = [place["referenceLocator"] for package in bill["packages"] for place in package.get("externalRefs", [])]
assert "pkg:npm/%40gltf-transform/core" in places
assert (wheel, "STATIC_LINK", "SPDXRef-deb-nlohmann-json3-dev") in links
PROGRAM
expect_exit 0 bill
cmp "$work/output" "$work/bill.json" || fail "two bills of one release differ"
