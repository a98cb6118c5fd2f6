#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles a precompiled header with clang, and writes a checksum of what is in it.

    compile_pch.py COMPILER ARGUMENTS...

clang writes absolute paths into a precompiled header, so two checkouts never have the same one. With
its checksum beside it (OUTPUT.sum), ccache reads that in its place (pch_external_checksum): equal if
the compiler, the flags but for paths, the text of all headers and the macros they define are equal.
"""
import hashlib
import pathlib
import subprocess
import sys


def main():
    command = sys.argv[1:]
    done = subprocess.run(command, check=False)
    if done.returncode or '-emit-pch' not in command:
        return done.returncode
    output = pathlib.Path(command[command.index('-o') + 1])
    emit = command.index('-emit-pch')
    text_only = command[:emit - 1] + command[emit + 1:]  # without its -Xclang
    for option, count in (('-o', 2), ('-MD', 1), ('-MT', 2), ('-MF', 2), ('-c', 1)):
        at = text_only.index(option)
        del text_only[at:at + count]
    text = subprocess.run([*text_only, '-E', '-P', '-dD'], stdout=subprocess.PIPE, check=True).stdout
    version = subprocess.run([command[0], '--version'], stdout=subprocess.PIPE, check=True).stdout
    flags = [word for word in text_only if '/' not in word]
    checksum = hashlib.sha256(version + '\0'.join(flags).encode() + b'\0' + text)
    pathlib.Path(f'{output}.sum').write_text(checksum.hexdigest() + '\n', encoding='utf-8')
    return 0


if __name__ == '__main__':
    sys.exit(main())
