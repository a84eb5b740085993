#!/usr/bin/env python3
"""Counts test cases in result files and prints "PASSED FAILED".

usage: count_results.py gtest FILE            a file of --gtest_output=xml:
       count_results.py ctest FILE DIRECTORY  a file of ctest --output-junit; where the directory has a gtest file of a
                                              test's name, the cases in that file count instead of the test
       count_results.py unittest FILE         the output of python3 -m unittest
"""

import os
import re
import sys
import xml.etree.ElementTree


def count_gtest(path):
    passed = failed = 0
    for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        if case.get("status") == "run":
            if case.find("failure") is None:
                passed += 1
            else:
                failed += 1
    return passed, failed


def count_ctest(path, gtest_directory):
    passed = failed = 0
    for test in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        ok = test.get("status") == "run"
        cases = os.path.join(gtest_directory, test.get("name") + ".xml")
        counts = count_gtest(cases) if os.path.exists(cases) else (int(ok), 0)
        passed += counts[0]
        # A program that crashes fails without a failed case.
        failed += counts[1] if ok else max(counts[1], 1)
    return passed, failed


def count_unittest(path):
    with open(path) as log:
        text = log.read()
    run = int(re.findall(r"^Ran (\d+) tests? in", text, re.MULTILINE)[-1])
    status = re.findall(r"^(?:OK|FAILED)(?: \((.*)\))?$", text, re.MULTILINE)[-1]
    other = dict((key, int(value)) for key, value in re.findall(r"([a-z ]+)=(\d+)", status))
    failed = other.get("failures", 0) + other.get("errors", 0)
    return run - failed - other.get("skipped", 0), failed


if __name__ == "__main__":
    counters = {"gtest": count_gtest, "ctest": count_ctest, "unittest": count_unittest}
    print("%d %d" % counters[sys.argv[1]](*sys.argv[2:]))
