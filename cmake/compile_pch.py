#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles a precompiled header, and writes a checksum of what is in it.

    compile_pch.py [LAUNCHER...] -- COMPILER ARGUMENTS...

Two precompiled headers of one text are never the same: clang writes absolute paths into them, and
g++ what lay in its memory. With its checksum beside it (OUTPUT.sum), ccache reads that in its place
(pch_external_checksum): equal if the compiler, the flags but for paths, the text of all headers and
the macros they define are equal.
"""
import hashlib
import pathlib
import subprocess
import sys


def find_output(command):
    """The precompiled header that a command makes, or none: its target has an empty source as well."""
    if '-emit-pch' in command or 'c++-header' in command:
        return command[command.index('-o') + 1]
    return None


def preprocessing(command):
    """The command that writes the text and the macros of what another precompiles."""
    words = list(command)
    if '-emit-pch' in words:
        emit = words.index('-emit-pch')
        del words[emit - 1:emit + 1]  # with its -Xclang
    for option, count in (('-o', 2), ('-MD', 1), ('-MT', 2), ('-MF', 2), ('-c', 1)):
        at = words.index(option)
        del words[at:at + count]
    return [*words, '-E', '-P', '-dD']


def main():
    split = sys.argv.index('--')
    launcher, command = sys.argv[1:split], sys.argv[split + 1:]
    done = subprocess.run([*launcher, *command], check=False)
    output = find_output(command)
    if done.returncode or not output:
        return done.returncode
    text_only = preprocessing(command)
    text = subprocess.run(text_only, stdout=subprocess.PIPE, check=True).stdout
    version = subprocess.run([command[0], '--version'], stdout=subprocess.PIPE, check=True).stdout
    version = version.partition(b' ')[2]  # g++ begins with the name that it is called by
    flags = [word for word in text_only if '/' not in word]
    checksum = hashlib.sha256(version + '\0'.join(flags).encode() + b'\0' + text)
    pathlib.Path(f'{output}.sum').write_text(checksum.hexdigest() + '\n', encoding='utf-8')
    return 0


if __name__ == '__main__':
    sys.exit(main())
