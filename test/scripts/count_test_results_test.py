"""The line `N passed, N failed` tells the truth about crashes, missing results and empty programs."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import count_test_results

CASE = '<testcase classname="A" name="{}" status="run" result="completed"/>'
FAILED_CASE = '<testcase classname="A" name="{}"><failure message="1 is not 2"/></testcase>'


class CountTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, *cases):
        with open(os.path.join(self.folder, name), "w") as results:
            results.write("<testsuites><testsuite>" + "".join(cases) + "</testsuite></testsuites>")

    def gtest(self, name):
        return name, [name, "--gtest_output=xml:{}/gtest-{}.xml".format(self.folder, name)]

    def rostest(self, name):
        return name, ["env", "run_tests.py", "{}/rostest-{}.xml".format(self.folder, name), "rostest ..."]

    def count(self, tests, failed=()):
        count = count_test_results.count_results(tests, set(failed))
        return count.passed, len(count.failures)

    def test_cases_are_counted_one_by_one(self):
        self.write("gtest-a.xml", CASE.format(1), CASE.format(2), FAILED_CASE.format(3))
        self.assertEqual(self.count([self.gtest("a")], ["a"]), (2, 1))

    def test_a_program_without_results_is_a_failure(self):
        self.assertEqual(self.count([self.gtest("a")], ["a"]), (0, 1))
        self.assertEqual(self.count([self.gtest("a")]), (0, 1))

    def test_a_cut_results_file_is_a_failure(self):
        with open(os.path.join(self.folder, "gtest-a.xml"), "w") as results:
            results.write("<testsuites><testsuite>")
        self.assertEqual(self.count([self.gtest("a")]), (0, 1))

    def test_a_program_that_ran_no_test_is_a_failure(self):
        self.write("gtest-a.xml")
        self.assertEqual(self.count([self.gtest("a")]), (0, 1))

    def test_a_crash_after_the_last_case_is_a_failure(self):
        self.write("gtest-a.xml", CASE.format(1))
        self.assertEqual(self.count([self.gtest("a")], ["a"]), (1, 1))

    def test_skipped_and_disabled_cases_do_not_pass(self):
        self.write("gtest-a.xml", '<testcase name="s" status="run" result="skipped"><skipped/></testcase>',
                   '<testcase name="d" status="notrun" result="suppressed"/>', CASE.format(1))
        self.assertEqual(self.count([self.gtest("a")]), (1, 2))

    def test_a_test_without_a_results_file_is_one_case(self):
        self.assertEqual(self.count([("consumer", ["cmake"])]), (1, 0))
        self.assertEqual(self.count([("consumer", ["cmake"])], ["consumer"]), (0, 1))

    def test_a_python_program_that_skips_cases_is_a_failure(self):
        log = os.path.join(self.folder, "LastTest.log")
        with open(log, "w") as output:
            output.write("1/3 Testing: whole\n1/3 Test: whole\nRan 3 tests in 1.0s\n\nOK\n<end of output>\nTest Passed.\n"
                         "2/3 Testing: partly\n2/3 Test: partly\nRan 3 tests in 1.0s\n\nOK (skipped=2)\n<end of output>\n"
                         "Test Passed.\n3/3 Testing: speaks\n3/3 Test: speaks\nskipped=1 link\nTest Passed.\n")
        self.assertEqual(count_test_results.skipped_in([log]), ["partly"])

    def test_no_test_at_all_is_a_failure(self):
        self.assertEqual(self.count([]), (0, 1))

    def test_the_cases_inside_a_rostest_are_counted(self):
        self.write("rostest-r.xml", CASE.format("testnode"))
        self.write("rosunit-node.xml", CASE.format(1), CASE.format(2), FAILED_CASE.format(3))
        self.assertEqual(self.count([self.rostest("r")], ["r"]), (2, 1))

    def test_a_rostest_node_that_crashed_is_a_failure(self):
        self.write("rostest-r.xml", FAILED_CASE.format("testnode"), CASE.format("testother"))
        self.write("rosunit-other.xml", CASE.format(1))
        self.assertEqual(self.count([self.rostest("r")], ["r"]), (1, 1))

    def test_a_rostest_that_never_started_is_a_failure(self):
        self.assertEqual(self.count([self.rostest("r")], ["r"]), (0, 1))

    def test_a_rostest_that_fails_as_a_whole_is_a_failure(self):
        self.write("rostest-r.xml", CASE.format("testnode"))
        self.write("rosunit-node.xml", CASE.format(1))
        self.assertEqual(self.count([self.rostest("r")], ["r"]), (1, 1))

    def test_two_rostests_that_write_the_same_file_are_noticed(self):
        self.write("rostest-r.xml", CASE.format("testnode"))
        self.write("rostest-s.xml", CASE.format("testnode"))
        self.write("rosunit-node.xml", CASE.format(1))
        self.assertEqual(self.count([self.rostest("r"), self.rostest("s")]), (1, 1))


if __name__ == "__main__":
    unittest.main()
