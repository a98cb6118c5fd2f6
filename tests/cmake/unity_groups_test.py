#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which files cmake/unity_groups.py puts together."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

DUT = pathlib.Path(__file__).resolve().parents[2] / 'cmake/unity_groups.py'


def unnamed(text):
    return f'namespace floorproof {{\nnamespace {{\n\n{text}\n\n}}  // namespace\n}}  // namespace floorproof\n'


class UnityGroups(unittest.TestCase):
    def groups(self, files, most=8):
        """The sets of files that are compiled as one; files: text by name."""
        with tempfile.TemporaryDirectory() as root:
            root = pathlib.Path(root, 'a folder & ünity')
            root.mkdir()
            for name, text in files.items():
                (root / name).write_text(text)
            self.out = root / 'out'
            asked = ''.join(f'fp_x;{root}/{name}\n' for name in files if name.endswith('.cc'))
            for _ in range(2):  # the second time it finds its own files
                subprocess.run([sys.executable, DUT, root, self.out, str(most)], input=asked, text=True,
                               check=True)
            self.cmake = (self.out / 'groups.cmake').read_text()
            return [set(re.findall(r'^#include "([^"]+)"$', unity.read_text(), re.M))
                    for unity in sorted(self.out.glob('*.cc'))]

    def test_files_with_names_of_their_own_are_together(self):
        self.assertEqual(self.groups({'a.cc': unnamed('int A() { return 1; }'),
                                      'b.cc': unnamed('int B() { return 1; }')}), [{'a.cc', 'b.cc'}])

    def test_no_more_than_asked_for(self):
        files = {f'{name}.cc': '' for name in 'abcde'}
        self.assertEqual(sorted(map(len, self.groups(files, most=2))), [2, 2])  # one stays alone

    def test_cmake_is_told_what_is_together(self):
        self.groups({'a.cc': '', 'b.cc': ''})
        root = self.out.parent
        self.assertIn(f'fp_compile_as_one(fp_x [==[{self.out}/fp_x_0.cc]==] [==[{root}/a.cc]==] '
                      f'[==[{root}/b.cc]==])\n', self.cmake)

    def test_files_include_by_names_that_are_the_same_in_every_clone(self):
        self.assertEqual(self.groups({'a.cc': '', 'b.cc': ''}), [{'a.cc', 'b.cc'}])

    def test_one_name_twice_is_apart(self):
        for text in ('constexpr double kNear_m = 1;', 'struct Options {\n  int n;\n};',
                     'bool Fits(int n) { return n > 1; }', 'constexpr int kA = 1,\n              kB = 2;',
                     'template <typename T>\nT Twice(T x) {\n  return 2 * x;\n}',
                     'std::vector<int> found;', 'using Json = nlohmann::json;\nint Of(Json json);'):
            files = {'a.cc': unnamed(text), 'b.cc': unnamed(text)}
            self.assertEqual(self.groups(files), [], text)

    def test_a_name_that_means_something_else_there_is_apart(self):
        self.assertEqual(self.groups({'a.cc': unnamed('constexpr int kTop = 1;'),
                                      'b.cc': 'int Of() {\n  const int kTop = 2;\n  return kTop;\n}\n'}),
                         [])
        self.assertEqual(self.groups({'a.cc': unnamed('int Length() { return 1; }'),
                                      'b.cc': '#include "b.h"\n', 'b.h': 'int Length(int n);\n'}), [])
        self.assertRegex(self.cmake, r'set_property(?s:.*)/b\.h\]')

    def test_what_may_be_said_twice_does_not_part(self):
        for text in ('using Json = nlohmann::json;', 'namespace fs = std::filesystem;',
                     'using testing::HasSubstr;'):
            files = {'a.cc': unnamed(text), 'b.cc': unnamed(text)}
            self.assertEqual(self.groups(files), [{'a.cc', 'b.cc'}], text)
        self.assertEqual(self.groups({'a.cc': unnamed('using Json = nlohmann::json;'),
                                      'b.cc': unnamed('using Json = nlohmann::ordered_json;')}), [])

    def test_comments_and_texts_hold_no_names(self):
        self.assertEqual(self.groups({'a.cc': unnamed('constexpr int kTop = 1;'),
                                      'b.cc': '// kTop\nconst char* Of() { return "kTop"; }\n'}),
                         [{'a.cc', 'b.cc'}])


unittest.main()
