#!/usr/bin/env python3
"""scripts/evaluation/count_run_flops.py knows what an instruction computes, and adds up a dump of callgrind by address."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts" / "evaluation"))

import count_run_flops  # noqa: E402  (the path comes first)


class FlopsOf(unittest.TestCase):
    def test_counts_every_lane_of_arithmetic(self):
        for name, operands, flops in [("addsd", "%xmm0,%xmm1", 1), ("subpd", "(%rax),%xmm1", 2), ("mulps", "%xmm0,%xmm1", 4),
                                      ("vdivpd", "%ymm0,%ymm1,%ymm2", 4), ("sqrtsd", "%xmm0,%xmm0", 1), ("faddp", "", 1)]:
            self.assertEqual(count_run_flops.flops_of(name, operands), flops, name)

    def test_counts_both_halves_of_a_fused_operation(self):
        self.assertEqual(count_run_flops.flops_of("vfmadd231sd", "%xmm0,%xmm1,%xmm2"), 2)
        self.assertEqual(count_run_flops.flops_of("vfnmadd132pd", "%ymm0,%ymm1,%ymm2"), 8)

    def test_counts_nothing_else(self):
        for name in ("add", "addq", "sub", "imul", "div", "ucomisd", "movsd", "cvtsi2sd", "maxsd", "andpd", "paddd", "call"):
            self.assertEqual(count_run_flops.flops_of(name, "%xmm0,%xmm1"), 0, name)


class CountDump(unittest.TestCase):
    def count(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "dump.1"
            path.write_text(text, encoding="utf-8")
            return count_run_flops.count_dump(path)

    def setUp(self):
        self.known = count_run_flops.arithmetic_of
        count_run_flops.arithmetic_of = lambda program: ({0x10: 1, 0x18: 2}, (0x10, 0x14, 0x18)) if program == "/a" else ({}, ())

    def tearDown(self):
        count_run_flops.arithmetic_of = self.known

    def test_leaves_out_what_a_callee_took(self):
        text = "ob=/a\nfn=f\n0x10 5\n0x14 5\ncob=/b\ncfn=g\ncalls=5 0x18\n0x14 900\n0x18 3\n"
        self.assertEqual(self.count(text), (5 * 1 + 3 * 2, 13))

    def test_refuses_code_that_nobody_can_read(self):
        with self.assertRaises(SystemExit):
            self.count("ob=???\n0x10 5\n0x14 5\n")


if __name__ == "__main__":
    unittest.main()
