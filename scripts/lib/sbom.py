#!/usr/bin/env python3
"""Lists what a release consists of, and the libraries in it, as SPDX 2.3 in JSON on standard output.

Usage: scripts/lib/sbom.py VERSION FOLDER

FOLDER contains the archive of the sources, and packages. The libraries are those that the packages themselves list
(Depends of Debian, Requires-Dist of Python, dependencies of npm), and those that are compiled in
(packages/debian/compiled_in.txt). The time is SOURCE_DATE_EPOCH. The same packages give the same bytes.
"""
import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from email.parser import Parser
from pathlib import Path
from urllib.parse import quote

PACKAGES = Path(__file__).resolve().parents[2] / "packages"
COMPILED_IN = [line.split() for line in (PACKAGES / "debian/compiled_in.txt").read_text().splitlines() if not line.startswith("#")]
IN_PROGRAMS = [package for package, _ in COMPILED_IN]
IN_COMMANDS = [package for package, where in COMPILED_IN if where != "programs"]
IN_LIBRARY = [package for package, where in COMPILED_IN if where == "library"]


def installed(package):
    """Returns (version, architecture) of a Debian package on this machine."""
    shown = subprocess.run(["dpkg-query", "--show", "--showformat=${Version} ${Architecture}\n", package],
                           capture_output=True, text=True)
    return shown.stdout.splitlines()[0].split() if shown.stdout else (None, None)


def pinned(package):
    """Returns the version of a Python package that makes wheels."""
    return re.search(rf"^{package}==(\S+)$", (PACKAGES / "python/pinned.txt").read_text(), re.MULTILINE)[1]


def spdx_id(*words):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(words))


def element(identifier, name, version, **more):
    found = {"SPDXID": identifier, "name": name, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
             "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION", "copyrightText": "NOASSERTION", **more}
    return found | ({"versionInfo": version} if version else {})


def library(kind, name, version, qualifiers=""):
    locator = f"pkg:{kind}/{quote(name)}" + (f"@{quote(version, safe='')}" if version else "") + qualifiers
    return element(spdx_id(kind.split("/")[0], name), name, version, externalRefs=[
        {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": locator}])


def debian(package):
    version, architecture = installed(package)
    return library("deb/debian", package, version, f"?arch={architecture}" if architecture else "")


def links_of(path):
    """Returns [(relationship, library)] of a package."""
    if path.suffix == ".deb":
        control = subprocess.run(["dpkg-deb", "--field", path], check=True, capture_output=True, text=True).stdout
        fields = Parser().parsestr(control)
        needed = [re.split(r"[ (|:]", word.strip())[0] for word in fields.get("Depends", "").split(",") if word.strip()]
        headers = {"remap-tools": IN_PROGRAMS, "libremap-dev": IN_LIBRARY}.get(fields["Package"], ())
        return [("DYNAMIC_LINK", debian(name)) for name in needed] + [("STATIC_LINK", debian(name)) for name in headers]
    if path.suffix == ".whl":
        with zipfile.ZipFile(path) as wheel:
            metadata = next(name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
            fields = Parser().parsestr(wheel.read(metadata).decode())
        # Packages that only an extra needs ("; extra == ...") are not dependencies.
        needed = [re.match(r"[\w.-]+", line)[0] for line in fields.get_all("Requires-Dist", []) if "extra ==" not in line]
        return [("STATIC_LINK", debian(name)) for name in IN_COMMANDS] + [("STATIC_LINK", library("pypi", "nanobind", pinned("nanobind")))] + [
            ("DEPENDS_ON", library("pypi", name, None)) for name in needed]
    if path.suffix == ".tgz":
        with tarfile.open(path) as archive:
            manifest = json.load(archive.extractfile("package/package.json"))
        return [("STATIC_LINK", debian(name)) for name in IN_COMMANDS] + [
            ("DEPENDS_ON", library("npm", name, None)) for name in sorted(manifest.get("dependencies", {}))]
    return []


def bill(version, folder):
    created = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    packages, relationships = {}, []
    hashes = hashlib.sha256()
    for path in sorted(folder.iterdir()):
        if path.name.endswith((".spdx.json", "SHA256SUMS")):
            continue
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        hashes.update(digest.encode())
        own = spdx_id("file", path.name)
        packages[own] = element(own, path.name, version, packageFileName=path.name, licenseDeclared="MIT",
                                copyrightText="Copyright (c) 2026 The remap developers",
                                checksums=[{"algorithm": "SHA256", "checksumValue": digest}])
        relationships.append({"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": own})
        for relationship, found in links_of(path):
            packages[found["SPDXID"]] = found
            relationships.append({"spdxElementId": own, "relationshipType": relationship, "relatedSpdxElement": found["SPDXID"]})
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"remap-{version}",
            "documentNamespace": f"https://remap.example/spdx/remap-{version}-{hashes.hexdigest()}",
            "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
                             "creators": ["Organization: The remap developers", f"Tool: remap-scripts-release-{version}"]},
            "packages": list(packages.values()), "relationships": relationships}


if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
    print(__doc__)
    sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
print(json.dumps(bill(sys.argv[1], Path(sys.argv[2])), indent=2))
