"""tools/check_sizes.py finds what is too long, and nothing else."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_sizes.py"


def run_on(files):
    """Runs the tool on a tree made of `files`, path -> text; gives its exit status and output."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            target = pathlib.Path(root) / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, TOOL, root], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout


def lines(count):
    """So many lines of statements."""
    return "  f();\n" * count


class CheckSizes(unittest.TestCase):
    def test_what_is_as_long_as_it_may_be_is_silent(self):
        status, output = run_on({
            "src/a.cpp": "//\n" * 350,
            "tests/b.cpp": "namespace n {\nvoid f() {\n" + lines(58) + "}\n}\n",
        })
        self.assertEqual((status, output), (0, "no file and no function is too long\n"))

    def test_a_file_of_a_line_more_is_named(self):
        for folder in ("src", "include/n", "tests/a", "benchmarks", "fuzz", "examples"):
            status, output = run_on({folder + "/a.h": "//\n" * 351})
            self.assertEqual(status, 1)
            self.assertIn(folder + "/a.h:1: 351 lines, of at most 350", output)

    def test_a_function_of_a_line_more_is_named_wherever_it_stands(self):
        for before, after in (("", ""), ("namespace a::b {\n", "}\n"), ("namespace {\n", "}\n"),
                              ("struct S {\n", "};\n"), ('extern "C" ', ""), ("template <class T = A<B>>\n", ""),
                              ("class S : T {\n public:\n", "};\n"),
                              ("const char* brace = \"{\"; /* { */\nchar c = '{';\n", ""),
                              ("auto text = R\"(\n{ \")\";\nint n = 1'000;\n", ""),
                              ("#define OPEN \\\n  {\n", ""),
                              ("int table[] = {\n" + lines(99) + "};\n", "")):
            text = before + "void f(int n) {\n" + lines(59) + "}\n" + after
            status, output = run_on({"src/a.cpp": text})
            self.assertEqual(status, 1, text)
            line = text[:text.index("void f")].count("\n") + 1
            if before.startswith("template"):
                line -= 1
            self.assertIn(f"src/a.cpp:{line}: a function of 6", output)
            self.assertIn("void f(int n)", output)
            self.assertEqual(output.count("\n"), 1)

    def test_lambdas_and_local_classes_count_to_their_function(self):
        body = ("  const auto g = [](int i) {\n" + lines(28) + "  };\n" +
                "  struct S {\n" + lines(28) + "  };\n")
        status, output = run_on({"src/a.cpp": "void f() {\n" + body + "}\n"})
        self.assertEqual(status, 1)
        self.assertIn("src/a.cpp:1: a function of 62 lines", output)

    def test_classes_enums_and_tables_may_be_long(self):
        member = "  void f() {\n  }\n"
        text = ("class C {\n" + member * 40 + "};\nenum class E {\n" + "  a,\n" * 70 + "};\n"
                "constexpr int table[] = {\n" + "  1,\n" * 70 + "};\n")
        self.assertEqual(run_on({"src/a.h": text})[0], 0)


if __name__ == "__main__":
    unittest.main()
