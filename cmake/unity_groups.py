#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Says which source files of a target can be compiled as one (CMake's UNITY_GROUP).

Files that are compiled as one share their unnamed namespaces. Two of them may therefore not be
together when one file's own name is a word of the other: it would be defined twice, be hidden, or
be taken for the other. Such files go into different groups by themselves, so that whoever adds a
file need not know the names in the others.

    unity_groups.py ROOT FOLDER FILES_A_GROUP <LINES      each line: TARGET;FILE

Writes FOLDER/TARGET_NUMBER.cc for each group, which includes its files by their paths from ROOT, and
FOLDER/groups.cmake, which tells CMake of the groups and of every file that the answer depends on. Own
names are looked for as clang-format leaves them: what an unnamed namespace holds begins at the line's
first column.
"""
import collections
import functools
import os
import pathlib
import re
import sys

UNNAMED = re.compile(r'^namespace \{$(.*?)^\}  // namespace$', re.M | re.S)
TYPE = re.compile(r'^(?:struct|class|enum class|enum|union) (\w+)')
ALIAS = re.compile(r'^(?:using|namespace) (\w+) = ')
BORROWED = re.compile(r'^using [\w:]*::(\w+);')
CONSTANT = re.compile(r'\b(k[A-Z]\w*)\s*[={\[(;]')
LISTED = re.compile(r'\b(k[A-Z]\w*),')
FUNCTION = re.compile(r'\b(\w+)\(')
VARIABLE = re.compile(r'\b(\w+)(?: =|;|\{)')
MACRO = re.compile(r'[A-Z][A-Z0-9_]*$')
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"', re.S)


def declared(text):
    """Names declared at the first column; with its line what may be said twice in the same words."""
    names = {}
    statement = ''
    for line in text.split('\n'):
        if not line or not (line[0].isalpha() or line[0] == '_'):
            if statement:  # a list of constants goes on over several lines
                names.update((name, None) for name in CONSTANT.findall(line))
                if line.endswith(';'):
                    statement = ''
            continue
        statement = '' if line.endswith((';', '{')) else line
        if alias := ALIAS.match(line) or BORROWED.match(line):
            names[alias[1]] = line
        elif kind := TYPE.match(line):
            names[kind[1]] = None
        else:
            constant = CONSTANT.search(line)
            function = FUNCTION.search(line)
            if function and (not constant or function.start() < constant.start()):
                found = [function[1]]
                statement = ''  # its parameters may go on, and its body declares nothing of the file
            elif constant:
                found = CONSTANT.findall(line)
            else:
                found = VARIABLE.findall(line)[:1]
            names.update((name, None) for name in found if not MACRO.match(name))
    return names


class File:
    def __init__(self, root, path):
        self.path = path
        with open(path, encoding='utf-8') as stream:
            text = stream.read()
        code = COMMENT_OR_TEXT.sub(' ', text)
        # What stands behind a dot, an arrow or :: is looked up elsewhere.
        self.words = set(re.findall(r'(?<![.>:\w])\w+', code))
        self.own = {}
        for unnamed in UNNAMED.findall(text):
            self.own.update(declared(unnamed))
        # Members too, where they are named as constants are: a constant of that name would hide them.
        self.declared = set(declared(text)) | set(CONSTANT.findall(code)) | set(LISTED.findall(code))
        self.includes = [included for name in INCLUDE.findall(text)
                         if os.path.exists(included := os.path.join(root, name))]

    def headers(self):
        seen, waiting = set(), list(self.includes)
        while waiting:
            path = waiting.pop()
            if path not in seen:
                seen.add(path)
                waiting += load(path).includes
        return seen

    @functools.cached_property
    def declared_in_headers(self):
        return set().union(*(load(path).declared for path in self.headers()))

    def disturbs(self, other):
        """True when a name of this file's own means something else in the other file."""
        for name, line in self.own.items():
            same = line and other.own.get(name) == line
            borrowed = line and BORROWED.match(line) and name not in other.own
            if not same and not borrowed and (name in other.words or
                                              name in other.declared_in_headers):
                return True
        return False


@functools.lru_cache(maxsize=None)
def load(path):
    return File(sys.argv[1], path)


def grouped(lines, most):
    """The groups of each target: lists of files."""
    groups = collections.defaultdict(list)
    for line in lines:
        target, _, path = line.partition(';')
        file = load(path)
        for group in groups[target]:
            if len(group) < most and not any(file.disturbs(other) or other.disturbs(file)
                                             for other in group):
                group.append(file)
                break
        else:
            groups[target].append([file])
    return groups


def write(path, text):
    """Writes the file only if its text changes, so that an unchanged file is not compiled again."""
    if not path.exists() or path.read_text(encoding='utf-8') != text:
        path.write_text(text, encoding='utf-8')


def quoted(*texts):
    return ' '.join(f'[==[{text}]==]' for text in texts)


def main():
    root, folder, most = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    groups = grouped(sys.stdin.read().splitlines(), int(most))
    cmake, written = [], {folder / 'groups.cmake'}
    for target, of_target in groups.items():
        for number, group in enumerate(of_target):
            if len(group) == 1:
                continue
            unity = folder / f'{target}_{number}.cc'
            write(unity, ''.join(f'#include "{os.path.relpath(file.path, root)}"\n' for file in group))
            written.add(unity)
            cmake.append(f'fp_compile_as_one({target} {quoted(unity, *(file.path for file in group))})\n')
    for stale in set(folder.iterdir()) - written:
        stale.unlink()
    read = {file.path for of_target in groups.values() for group in of_target for file in group}
    for path in list(read):
        read |= load(path).headers()
    cmake.append('set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS\n  '
                 + '\n  '.join(quoted(path) for path in [__file__, *sorted(read)]) + ')\n')
    write(folder / 'groups.cmake', ''.join(cmake))


main()
