#!/usr/bin/env python3
"""Counts test cases in result files and prints "PASSED FAILED"; describes the failed ones on the error output.

usage: count_results.py FILE DIRECTORY    a file of ctest --output-junit; if the directory has a gtest file of a test's
                                          name, the cases in that file count instead of the test
"""

import os
import sys
import xml.etree.ElementTree


def describe(name, text):
    print("FAILED: %s\n%s" % (name, (text or "").strip()[:2000]), file=sys.stderr)


def test_cases(path):
    return xml.etree.ElementTree.parse(path).getroot().iter("testcase")


def count_gtest(path):
    passed = failed = 0
    for case in test_cases(path):
        if case.get("status") == "run":
            failures = case.findall("failure")
            if failures:
                failed += 1
                describe("%s.%s" % (case.get("classname"), case.get("name")), "\n".join(f.text or "" for f in failures))
            else:
                passed += 1
    return passed, failed


def count_ctest(path, gtest_directory):
    passed = failed = 0
    for test in test_cases(path):
        # A test that skips itself counts as one that ran, as it does in the results of opencv_ts.
        skipped = test.find("skipped")
        ok = test.get("status") == "run" or skipped is not None and skipped.get("message", "").startswith("SKIP_")
        cases = os.path.join(gtest_directory, test.get("name") + ".xml")
        counts = count_gtest(cases) if os.path.exists(cases) else (int(ok), 0)
        passed += counts[0]
        failed += counts[1]
        if counts[1] == 0 and (not ok or counts[0] == 0):
            # Not a program with cases, or one that has crashed, or one without any case.
            failed += 1
            describe(test.get("name"), test.findtext("system-out"))
    return passed, failed


if __name__ == "__main__":
    print("%d %d" % count_ctest(*sys.argv[1:]))
