#!/usr/bin/env python3
"""check_judge.py TEXREMAP [--size 128] [--seed-offset N] [--json FILE] measures how many faults `texremap check`
finds, and how often it gives false alarms.

It makes the cases of check_cases.py in a temporary folder and checks each. A fault is found if a finding has one of
the expected rules and its fix (`fix`) matches the expression of the case. The exit code is 1, with the reasons, for
fewer than 18 of the 26 reports, for any finding on a clean set, and for any run that fails or whose exit code
contradicts its findings.
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    from jsonschema import validate  # raises ValidationError, which ends the judgement
except ImportError:
    validate = None

WANTED = 18
SCHEMA = json.loads((Path(__file__).resolve().parents[2] / "docs" / "check.schema.json").read_text())


def check(texremap, paths, reader):
    """Returns the findings in some paths, and what is wrong with the run itself ("" if nothing is)."""
    command = [texremap, "check", *map(str, paths), "--json", "--quiet", "--fail-on", "possible"] + (["--for", reader] if reader else [])
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=120)
        report = json.loads(run.stdout)
        if validate:
            validate(report, SCHEMA)
        findings = report["findings"]
        return findings, "" if run.returncode == bool(findings) else f"exit code {run.returncode} with {len(findings)} findings"
    except (OSError, ValueError, KeyError, TypeError, subprocess.TimeoutExpired) as error:
        last = run.stderr.strip().splitlines()[-1:] if "run" in locals() else []
        return [], f"no findings as JSON ({type(error).__name__}) {' '.join(last)}".strip()


def judge(case, findings):
    """Adds to the case: the rules found, the verdict, and the findings of other rules."""
    expected = [f for f in findings if f["rule"] in case["rules"]]
    fixed = any(re.search(case["fix"], str(f.get("fix") or ""), re.I | re.S) for f in expected)
    case["findings"], case["further"] = findings, [f for f in findings if f["rule"] not in case["rules"]]
    if case["report"] == "clean":
        case["verdict"] = "FALSE ALARM" if findings else "right"
    else:
        case["verdict"] = "right" if fixed else "wrong fix" if expected else "missed"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("texremap")
    parser.add_argument("--size", default="128")
    parser.add_argument("--seed-offset", default="0")
    parser.add_argument("--json", type=Path, help="write cases with their findings and verdicts")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as out:
        maker = Path(__file__).resolve().parent / "check_cases.py"
        subprocess.run([sys.executable, str(maker), out, "--size", args.size, "--seed-offset", args.seed_offset], check=True)
        cases = json.loads(Path(out, "cases.json").read_text())
        clean_paths = [Path(out, c["path"]) for c in cases if c["report"] == "clean"]
        all_clean, clean_run = check(args.texremap, clean_paths, None)  # one process for all clean sets
        for case in cases:
            path = str(Path(out, case["path"]))
            if case["report"] == "clean":
                findings, case["run"] = [f for f in all_clean if f["path"].startswith((path + "/", path + ":")) or f["path"] == path], clean_run
            else:
                findings, case["run"] = check(args.texremap, [path], case["for"])
            judge(case, findings)

    reports, own, clean = ([c for c in cases if kind(c["report"])] for kind in (
        lambda r: r not in ("own", "clean"), lambda r: r == "own", lambda r: r == "clean"))
    alarms, failed = [c for c in clean if c["findings"]], [c for c in cases if c["run"]]
    print(f"{'case':44} {'report':26} {'verdict':13} found rules")
    for c in reports + own + [c for c in clean if c["findings"] or c["run"]]:
        rules = " ".join(sorted({f"{f['rule']}({f.get('confidence', '?')})" for f in c["findings"]})) or "-"
        print(f"{c['name']:44} {c['report']:26} {c['verdict']:13} {rules} {c['run']}".rstrip())
    right = [sum(c["verdict"] == "right" for c in group) for group in (reports, own)]
    print(f"\nreports found with the right remedy: {right[0]} of {len(reports)}\nown faults found with the right remedy: {right[1]} of {len(own)}")
    further = [c for c in reports + own if c["further"]]
    print(f"further findings on faults: {sum(len(c['further']) for c in further)} on {len(further)} cases")
    for c in further:
        print(f"  {c['name']}: " + "; ".join(f"{f['rule']}: {f.get('message', '')}" for f in c["further"]))
    print(f"false alarms on clean sets: {len(alarms)} of {len(clean)}")
    for c in alarms:
        print(f"  {c['name']}: " + "; ".join(f"{f['rule']}: {f.get('message', '')}" for f in c["findings"]))
    if args.json:
        args.json.write_text(json.dumps(cases, indent=1) + "\n")

    reasons = [f"{right[0]} reports found, {WANTED} wanted; not found: " + ", ".join(c["report"] for c in reports if c["verdict"] != "right")
               ] if right[0] < WANTED else []
    reasons += [f"{len(alarms)} false alarms: " + ", ".join(c["name"] for c in alarms)] if alarms else []
    reasons += [f"{len(failed)} runs failed: " + ", ".join(f"{c['name']} ({c['run']})" for c in failed)] if failed else []
    print("every report is valid by docs/check.schema.json" if validate else "no python3-jsonschema: the schema was not applied")
    print("\n".join("FAILED: " + r for r in reasons) or "passed")
    sys.exit(bool(reasons))


if __name__ == "__main__":
    main()
