"""Allowed content and calls of an object: objects made by hand, each with one forbidden thing."""

import subprocess
import tempfile
import unittest
from pathlib import Path

import sandbox  # noqa: F401

from grading.allowed import not_allowed, shown, tampering
from grading.elf import TooLarge, Unreadable, read_object

COURSE = frozenset({"_ZN5spook5driftERKN5Eigen6MatrixE"})


class Allowed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def made(self, assembly: str):
        file = self.folder / "made.o"
        subprocess.run(["as", "-o", str(file), "-"], input=(assembly + "\n").encode(errors="surrogateescape"), check=True)
        return read_object(file)

    def test_sections(self):
        for section, refused in ((".text.hot", False), (".data.rel.ro.local", False), (".init_array", False),
                                 (".rodata.str1.1", False), (".gcc_except_table", False), (".tbss", False),
                                 (".init", True), (".fini", True), (".preinit_array", True), (".fini_array", True),
                                 (".init_array.00001", True), (".ctors", True), (".dtors.65535", True),
                                 (".gnu.lto_.decls", True), (".gnu.warning.kick", True), (".got.plt", True),
                                 (".interp", True), (".dynamic", True), ("hidden", True), (".textual", True)):
            with self.subTest(section):
                self.assertEqual(bool(tampering(self.made(f'.section {section},"a"\n.long 0'))), refused)

    def test_names_of_any_bytes_are_shown_in_a_few_letters(self):
        for name in ("x\udcff", "x\x1b[31m", "x\\n| 5 of 5 |", "x`<b>", "x" * 9999, "xÖ"):
            for assembly in (f'.section "{name}","a"\n.long 0', f'.quad "{name}"', f'.weak "{name}"\n.quad "{name}"',
                             f'.comm "{name}",8'):
                with self.subTest(assembly[:99]):
                    made = self.made(assembly)
                    told = tampering(made) or shown(not_allowed(made, COURSE))
                    self.assertRegex(told, r"\A[\w.$@ ?',()-]{2,160}\Z")
                    self.assertTrue(told.isascii(), told)

    def test_calls(self):
        for name in ("fork", "_Fork", "fexecve", "pkey_mprotect", "execveat", "posix_spawn", "socket",
                     "write", "dlsym", "_Unwind_Backtrace", "__bss_start", "_end"):
            for how in (f".globl {name}\n.quad {name}", f".weak {name}\n.quad {name}",
                        f".globl other\n.set other, {name}\n.quad other"):
                with self.subTest(how):
                    self.assertEqual(tampering(self.made(how)), f"calls {name}()")

    def test_what_is_replaced_is_no_crime_unless_it_hides(self):
        for name in ("system", "syscall"):
            self.assertEqual(tampering(self.made(f".quad {name}")), "")
            self.assertEqual(not_allowed(self.made(f".quad {name}"), COURSE), "")
            self.assertEqual(tampering(self.made(f".weak {name}\n.quad {name}")), f"calls {name}()")

    def test_what_replaces_another_programs(self):
        for assembly in (".globl write\n.type write,@gnu_unique_object\nwrite: .quad 0", ".comm write,8",
                         ".type resolve,@gnu_indirect_function\n.globl resolve\nresolve: .quad 0",
                         "_ZN7testing8UnitTest11GetInstanceEv: .quad 0", ".weak anything\n.quad anything"):
            with self.subTest(assembly):
                self.assertNotEqual(tampering(self.made(assembly)), "")

    def test_names_that_no_compiler_makes(self):
        for name in ("f@x", "f@@x", "f x", "f\tx", "@", "f\x7f"):
            for how in (f'.globl "{name}"\n"{name}": .quad 0', f'"{name}": .quad 0', f'.quad "{name}"'):
                with self.subTest(how):
                    self.assertIn("no compiler names", tampering(self.made(how)))
        self.assertIn("no compiler names", tampering(self.made(".globl f\nf: .symver f, kick@x")))
        self.assertEqual(tampering(self.made('.globl "gΔx"\n"gΔx": .quad 0')), "")

    def test_what_counts_operations_is_not_replaced(self):
        self.assertIn("counts", tampering(self.made("__sanitizer_cov_trace_pc: ret")))

    def test_the_memory_that_it_needs(self):
        self.assertEqual(self.made(".data\n.zero 8\n.bss\n.zero 5000000000\n.section .debug_x\n.zero 7").memory, 5_000_000_008)

    def test_an_object_that_is_none(self):
        file = self.folder / "made.o"
        self.made(".quad f")
        whole = file.read_bytes()
        for content in (b"", b"text", whole[:70], whole[:-100], b"\x7fELF\1" + whole[5:]):
            file.write_bytes(content)
            with self.assertRaises(Unreadable):
                read_object(file)
        with self.assertRaisesRegex(TooLarge, "symbols"):
            self.made("\n".join(f".quad f{k}" for k in range(100_001)))
        long = "f" * (1 << 20)  # of which each shares the end, in the object
        with self.assertRaisesRegex(TooLarge, "names of more than 16 MiB"):
            self.made("\n".join(f".quad {'g' * k}{long}" for k in range(17)))

    def test_what_an_answer_calls(self):
        for name in ("sqrt", "hypotf", "memcpy", "printf", "__printf_chk", "_Znwm", "_ZdlPvm", "_ZSt4cout",
                     "_ZTISt9exception", "_ZTVN10__cxxabiv120__si_class_type_infoE", "__cxa_throw", "_Unwind_Resume",
                     "pthread_create", "_ZN5spook5driftERKN5Eigen6MatrixE", "clock_gettime",
                     "_ZNSt6thread4joinEv", "__muldc3",
                     "getpid", "isatty", "asprintf", "fesetround", "drem", "lgamma_r", "lgammaf_r",
                     "getline", "getrusage", "strcasecmp", "isupper", "localtime_r", "mbstowcs", "strtok_r", "remove",
                     "__gttf2", "__unordtf2", "__cpu_model"):
            with self.subTest(name):
                made = self.made(f".quad {name}")
                self.assertEqual((tampering(made), not_allowed(made, COURSE)), ("", ""))
        for name in ("setenv", "_ZN5spook6secretEv", "_ZN5spook5driftEv", "my_own", "chmod", "signal", "sigaction",
                     "longjmp", "mmap", "backtrace", "environ", "__getauxval", "__netf2x"):
            made = self.made(f".quad {name}")
            self.assertEqual((tampering(made), not_allowed(made, COURSE)), ("", name))


if __name__ == "__main__":
    unittest.main()
