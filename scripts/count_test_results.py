#!/usr/bin/env python3
"""Counts test cases after ctest has run: `N passed, N failed` is the last line, the exit status 1 unless all passed.

A case is one test of a GoogleTest program (alone or inside a rostest), or one whole ctest test that writes no
results, such as the consumer package. A program that crashed, timed out, was not built, wrote no results or ran no
test is one failed case; so is a run without any test, and a Python program that skipped some of its cases.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree


class Count:
    def __init__(self):
        self.passed = 0
        self.failures = []

    def add(self, failed_names, cases):
        self.passed += cases - len(failed_names)
        self.failures += failed_names


def read_cases(path):
    """The number of cases in a JUnit file and the names of those that did not pass; None when it is unreadable."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError):
        return None
    cases = list(root.iter("testcase"))
    not_passed = []
    for case in cases:
        unhappy = any(case.find(tag) is not None for tag in ("failure", "error", "skipped"))
        if unhappy or case.get("status", "run") != "run" or case.get("result", "completed") != "completed":
            not_passed.append("{}.{}".format(case.get("classname", ""), case.get("name", "")))
    return len(cases), not_passed


def count_result_file(count, test, path, failed):
    """One GoogleTest program's results; `failed` is what ctest or rostest says of the program."""
    cases = read_cases(path)
    if cases is None:
        count.add(["{}: crashed, timed out or was not built (no results)".format(test)], 1)
    elif cases[0] == 0:
        count.add(["{}: ran no test".format(test)], 1)
    else:
        count.add(["{}: {}".format(test, name) for name in cases[1]], cases[0])
        if failed and not cases[1]:
            count.add(["{}: failed outside of its cases".format(test)], 1)


def count_rostest(count, test, path, failed, inner_files_seen):
    """A rostest's own file names its test nodes, testNAME each; NAME's cases are in rosunit-NAME.xml beside it."""
    try:
        nodes = list(ElementTree.parse(path).getroot().iter("testcase"))
    except (OSError, ElementTree.ParseError):
        nodes = []
    if not nodes:
        count.add(["{}: crashed, timed out or was not built (no results)".format(test)], 1)
        return
    failures_before = len(count.failures)
    for node in nodes:
        name = re.sub("^test", "", node.get("name", ""))
        inner = os.path.join(os.path.dirname(path), "rosunit-{}.xml".format(name))
        if inner in inner_files_seen:
            count.add(["{}: another rostest has a node of the name {} too".format(test, name)], 1)
            continue
        inner_files_seen.add(inner)
        node_failed = node.find("failure") is not None or node.find("error") is not None
        count_result_file(count, "{} {}".format(test, name), inner, node_failed)
    if failed and len(count.failures) == failures_before:
        count.add(["{}: failed outside of its cases".format(test)], 1)


def result_file(command):
    """Where a test's command line says that it writes its results, and whether rostest does the writing."""
    line = " ".join(command)
    rostest = re.search(r"(\S+/rostest-\S+\.xml)", line)
    if rostest:
        return rostest.group(1), True
    gtest = re.search(r"--gtest_output=xml:(\S+)", line)
    return (gtest.group(1) if gtest else None), False


def count_results(tests, failed_names):
    """@param tests: (name, command) of each; @param failed_names: those that ctest reports as failed or not run."""
    count = Count()
    inner_files_seen = set()
    for name, command in tests:
        path, by_rostest = result_file(command)
        failed = name in failed_names
        if by_rostest:
            count_rostest(count, name, path, failed, inner_files_seen)
        elif path:
            count_result_file(count, name, path, failed)
        else:
            count.add([name] if failed else [], 1)
    if not tests:
        count.add(["no test was run"], 1)
    return count


def tests_of(build_dir):
    listing = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build_dir, check=True, stdout=subprocess.PIPE)
    return [(test["name"], test.get("command", [])) for test in json.loads(listing.stdout)["tests"]]


def names_in(failed_logs):
    names = set()
    for log in failed_logs:
        if os.path.exists(log):
            with open(log) as lines:
                names |= {line.strip().split(":", 1)[1] for line in lines if ":" in line}
    return names


def skipped_in(output_logs):
    """Names of the tests in which Python's unittest skipped cases, which is a success to ctest."""
    names = []
    for log in output_logs:
        with open(log, errors="replace") as lines:
            for part in re.split(r"^\d+/\d+ Testing: ", lines.read(), flags=re.MULTILINE)[1:]:
                if re.search(r"^OK \(.*skipped=\d", part, flags=re.MULTILINE):
                    names.append(part.split("\n", 1)[0])
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build_dir")
    parser.add_argument("--failed-log", action="append", default=[], help="a copy of ctest's LastTestsFailed.log")
    parser.add_argument("--output-log", action="append", default=[], help="a copy of ctest's LastTest.log")
    parser.add_argument("--failure", action="append", default=[], help="a failed case that is none of ctest's")
    parser.add_argument("--success", action="append", default=[], help="a passed case that is none of ctest's")
    arguments = parser.parse_args()
    failed = names_in(arguments.failed_log) | set(skipped_in(arguments.output_log))
    count = count_results(tests_of(arguments.build_dir), failed)
    count.add(arguments.failure, len(arguments.failure))
    count.add([], len(arguments.success))
    for failure in count.failures:
        print("FAILED: " + failure)
    print("{} passed, {} failed".format(count.passed, len(count.failures)))
    return 1 if count.failures else 0


if __name__ == "__main__":
    sys.exit(main())
