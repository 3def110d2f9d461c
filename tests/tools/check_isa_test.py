"""tools/check_isa.py finds what it is for, on examples of what `nm -C` prints."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import check_isa  # noqa: E402

TAG = "xsimd::avx512bw"


class CheckIsa(unittest.TestCase):
    def test_a_shared_inline_function_is_found(self):
        symbols = "0000000000000000 W portalens::length(portalens::Vec3<double>)\n"
        self.assertEqual(
            check_isa.untagged(symbols, TAG), ["portalens::length(portalens::Vec3<double>)"]
        )

    def test_a_tagged_template_may_stay(self):
        symbols = "0000000000000000 W portalens::step<xsimd::batch<float, xsimd::avx512bw> >()\n"
        self.assertEqual(check_isa.untagged(symbols, TAG), [])

    def test_strong_and_undefined_symbols_are_no_matter(self):
        symbols = "                 U memcpy\n0000000000000000 T portalens::step_lanes_avx512()\n"
        self.assertEqual(check_isa.untagged(symbols, TAG), [])

    def test_a_shared_constant_may_stay(self):
        symbols = "0000000000000000 u portalens::radau_nodes\n0000000000000000 V vtable\n"
        self.assertEqual(check_isa.untagged(symbols, TAG), [])

    def test_the_tag_of_another_set_is_found(self):
        symbols = "0000000000000000 W portalens::step<xsimd::batch<float, xsimd::sse4_2> >()\n"
        self.assertEqual(len(check_isa.untagged(symbols, TAG)), 1)


if __name__ == "__main__":
    unittest.main()
