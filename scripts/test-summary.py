#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums up a CTest run: test-summary.py RESULTS.xml CTEST_STATUS

Prints which tests were skipped and why, which failed, and as last line
"N passed, N failed, N skipped". Exit status 1 if a test failed or none ran.
"""
import re
import sys
import xml.etree.ElementTree as ElementTree


def reason_of_skip(case):
    """What the test itself said: GoogleTest prints "file:line: Skipped", then the message."""
    output = case.findtext("system-out") or ""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    for i, line in enumerate(lines):
        if re.search(r": Skipped$", line):
            return lines[i + 1] if i + 1 < len(lines) else "no reason given"
    skip = case.find("skipped")
    if lines:
        return lines[-1]
    return (skip.get("message") if skip is not None else None) or "no reason given"


def main():
    path, ctest_status = sys.argv[1], int(sys.argv[2])
    try:
        cases = list(ElementTree.parse(path).getroot().iter("testcase"))
    except (OSError, ElementTree.ParseError) as error:
        print(f"test: CTest left no results ({error})", file=sys.stderr)
        print("0 passed, 1 failed, 0 skipped")
        return 1

    passed, failed, skipped = [], [], {}
    for case in cases:
        name = case.get("name")
        if case.get("status") == "run" and case.find("failure") is None:
            passed.append(name)
        elif case.find("skipped") is not None and case.get("status") in ("notrun", "disabled"):
            skipped.setdefault(reason_of_skip(case), []).append(name)
        else:
            failed.append(name)

    print()
    for reason, names in sorted(skipped.items()):
        print(f"Skipped ({reason}):")
        for name in sorted(names):
            print(f"  {name}")
    if failed:
        print("Failed:")
        for name in sorted(failed):
            print(f"  {name}")
    if not passed and not failed:
        print("test: no test ran", file=sys.stderr)
    elif ctest_status != 0 and not failed:
        print(f"test: CTest ended with status {ctest_status}", file=sys.stderr)
    sys.stderr.flush()
    skip_count = sum(len(names) for names in skipped.values())
    print(f"{len(passed)} passed, {len(failed)} failed, {skip_count} skipped")
    return 1 if failed or not passed or ctest_status != 0 else 0


sys.exit(main())
