#!/usr/bin/env python3
"""Names of a header, and what the comparison of two interfaces says."""
import contextlib
import io
import os
import sys
import tempfile
import unittest
from unittest import mock

import stable_interface
from public_names import public_names

HEADER = """
#pragma once
#include <map>
namespace concave_distance {
namespace detail { struct Hidden { int inside; }; }
class Later;
/// struct Commented { int no; };
enum class Kind : unsigned char { First, Second = 4 };
inline constexpr double kLimit = 1.5, kOther{2.0};
using Names = std::map<int, std::pair<int, int>>;
template <typename T>
struct Row {
  struct Part { int depth = f(1, 2); };
  double distance = kLimit;  ///< metres
  std::function<void(std::size_t done, std::size_t count)> progress;
  std::uint64_t (*of)(const T& cost);
  int pair[2];
  bool isKnown() const { return distance < 1; }
  friend bool operator==(const Row& a, const Row& b);
};
class Tracker {
 public:
  explicit Tracker(int size) : size_(size) { grow(); }
  ~Tracker();
  Tracker& operator=(Tracker&& other) noexcept;
  bool operator<(const Tracker& other) const;
  const Row<int>& row(int index = 0) const;
 private:
  void grow();
  int size_;
};
Row<double> solve(const Tracker& tracker, std::function<void(int)> progress = {});
}
"""


class PublicNames(unittest.TestCase):
    def test_types_members_functions_and_constants_are_found(self):
        self.assertEqual(public_names(HEADER), [
            ([], "Kind"), (["Kind"], "First"), (["Kind"], "Second"), ([], "kLimit"), ([], "kOther"), ([], "Names"), ([], "Row"),
            (["Row"], "Part"), (["Row", "Part"], "depth"), (["Row"], "distance"), (["Row"], "progress"), (["Row"], "of"),
            (["Row"], "pair"), (["Row"], "isKnown"), ([], "Tracker"), (["Tracker"], "Tracker"), (["Tracker"], "~Tracker"),
            (["Tracker"], "operator="), (["Tracker"], "operator<"), (["Tracker"], "row"), ([], "solve")])


class Comparison(unittest.TestCase):
    PROMISED = {("message", "Niche"): {"aaaa"}, ("parameter", "node"): {"rate=50"}, ("c++", "tracking/pair.h Row"): {"id"}}

    def run_with(self, changes, list_of=None):
        now = {**self.PROMISED, **changes}
        with tempfile.TemporaryDirectory() as folder:
            place = os.path.join(folder, "list.txt")
            with open(place, "w", encoding="utf-8") as stream:
                stream.write(stable_interface.written(list_of or self.PROMISED))
            printed = io.StringIO()
            with mock.patch.object(stable_interface, "LIST", place), \
                    mock.patch.object(stable_interface, "interface", lambda programs: now), \
                    mock.patch.object(stable_interface, "version_faults", lambda programs: []), \
                    mock.patch.object(sys, "argv", ["stable_interface.py", "programs"]), \
                    contextlib.redirect_stdout(printed):
                status = stable_interface.main()
            return status, printed.getvalue()

    def test_the_same_interface_is_no_fault(self):
        self.assertEqual(self.run_with({}), (0, ""))

    def test_a_changed_message_is_named_with_what_to_do(self):
        status, text = self.run_with({("message", "Niche"): {"bbbb"}})
        self.assertEqual(status, 1)
        self.assertIn("gone or changed: message - Niche: aaaa\nnew: message - Niche: bbbb\n", text)
        for remedy in ("deprecated", "major version in package.xml", "CHANGELOG.rst", "--write"):
            self.assertIn(remedy, text)

    def test_a_changed_default_and_a_renamed_member_are_named(self):
        _, text = self.run_with({("parameter", "node"): {"rate=100"}, ("c++", "tracking/pair.h Row"): {"number"}})
        self.assertIn("gone or changed: c++ - tracking/pair.h Row: id\ngone or changed: parameter - node: rate=50\n", text)

    def test_what_is_new_asks_for_a_minor_version_only(self):
        status, text = self.run_with({("message", "Row"): {"cccc"}})
        self.assertEqual(status, 1)
        self.assertTrue(text.startswith("new: message - Row: cccc\nWhat is new is a promise"), text)
        self.assertIn("minor version", text)
        self.assertNotIn("major", text)

    def test_long_lists_are_read_as_they_were_written(self):
        names = {"name_%d" % index for index in range(200)}
        self.assertEqual(self.run_with({("c++", "long"): names}, {**self.PROMISED, ("c++", "long"): names}), (0, ""))


if __name__ == "__main__":
    unittest.main()
