#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What builds need to share the compiler cache (cmake/CompilerCache.cmake).

    compiler_cache_test.py CHECKOUT BUILD COMPILER
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CHECKOUT, BUILD = map(pathlib.Path, sys.argv[1:3])
COMPILER = sys.argv[3]
DUT = CHECKOUT / 'cmake/compile_pch.py'
IS_CLANG = 'clang' in subprocess.run([COMPILER, '--version'], stdout=subprocess.PIPE, text=True,
                                     check=True).stdout


class CacheKeys(unittest.TestCase):
    def test_no_macro_of_a_command_line_contains_an_absolute_path(self):
        ninja = (BUILD / 'build.ninja').read_text(encoding='utf-8')
        defines = re.findall(r'^  DEFINES = (.*)$', ninja, re.M)
        self.assertTrue(defines)
        self.assertEqual([line for line in defines if '="/' in line or '=/' in line or '\\"/' in line],
                         [])

    def test_of_the_generated_headers_none_contains_the_folder(self):
        headers = list((BUILD / 'generated').rglob('*.h'))
        self.assertTrue(headers)
        self.assertEqual([h for h in headers if str(BUILD) in h.read_text(encoding='utf-8')], [])


class PrecompiledHeaders(unittest.TestCase):
    """A header in a folder of its own, as CMake has it compiled."""

    def setUp(self):
        self.root = tempfile.TemporaryDirectory()
        self.addCleanup(self.root.cleanup)

    def checksum(self, folder, text, *flags, launcher=()):
        """Of this header, compiled in this folder; None where it does not compile."""
        path = pathlib.Path(self.root.name, folder)
        path.mkdir(exist_ok=True)
        (path / 'a.hxx').write_text(text)
        (path / 'a.cxx').write_text('')
        out = path / ('a.hxx.pch' if IS_CLANG else 'a.hxx.gch')
        emit = ['-Xclang', '-emit-pch', '-Xclang', '-include', '-Xclang', path / 'a.hxx'] if IS_CLANG \
            else ['-include', path / 'a.hxx']
        done = subprocess.run([sys.executable, DUT, *launcher, '--', COMPILER, '-I', path, *flags,
                               *emit, '-x', 'c++-header', '-MD', '-MT', out, '-MF', f'{out}.d', '-o', out,
                               '-c', path / 'a.cxx'], check=False, stderr=subprocess.PIPE)
        summed = pathlib.Path(f'{out}.sum')
        self.assertEqual(summed.exists(), done.returncode == 0)
        return summed.read_text() if summed.exists() else None

    def test_the_same_text_has_one_checksum_in_all_folders(self):
        text = '#define ANSWER 42\nint Answer();\n'
        self.assertEqual(self.checksum('here', text), self.checksum('ü & there', text))
        self.assertEqual(self.checksum('here', text, launcher=['env', 'A=1']), self.checksum('there', text))

    def test_another_text_macro_or_flag_has_another(self):
        base = self.checksum('a', '#define ANSWER 42\nint Answer();\n')
        for other in (('#define ANSWER 42\nlong Answer();\n',), ('#define ANSWER 43\nint Answer();\n',),
                      ('#define ANSWER 42\nint Answer();\n', '-O2'),
                      ('#define ANSWER 42\nint Answer();\n', '-DMORE=1')):
            self.assertNotEqual(self.checksum('a', *other), base, other)

    def test_of_one_that_does_not_compile_no_old_checksum_stays(self):
        self.assertIsNotNone(self.checksum('a', 'int A();\n'))
        self.assertIsNone(self.checksum('a', 'int A(\n'))


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
