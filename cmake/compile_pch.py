#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles a precompiled header, and writes a checksum of its contents.

    compile_pch.py [LAUNCHER...] -- COMPILER ARGUMENTS...

Precompiled headers of the same text differ byte for byte: clang stores absolute paths, and g++ an
image of its memory. Where OUTPUT.sum exists, ccache hashes it instead of the header
(pch_external_checksum). It depends on the compiler's version, the flags without paths, the text of
all headers, and the macros that they define.
"""
import hashlib
import pathlib
import subprocess
import sys


def find_output(command):
    """The precompiled header that `command` writes, or None: the target also has an empty source."""
    if '-emit-pch' in command or 'c++-header' in command:
        return command[command.index('-o') + 1]
    return None


def preprocessing(command):
    """The command that preprocesses the same header to stdout, and keeps macro definitions."""
    words = list(command)
    if '-emit-pch' in words:
        emit = words.index('-emit-pch')
        del words[emit - 1:emit + 1]  # with its -Xclang
    for option, count in (('-o', 2), ('-MD', 1), ('-MT', 2), ('-MF', 2), ('-c', 1)):
        if option in words:
            at = words.index(option)
            del words[at:at + count]
    return [*words, '-E', '-P', '-dD']


def checksum(command):
    """What the header depends on, as a hash; None where the compiler does not tell."""
    text_only = preprocessing(command)
    text = subprocess.run(text_only, stdout=subprocess.PIPE, check=False)
    version = subprocess.run([command[0], '--version'], stdout=subprocess.PIPE, check=False)
    if text.returncode or version.returncode:
        return None
    named = version.stdout.partition(b' ')[2]  # g++ prints first the name by which it was called
    flags = [word for word in text_only if '/' not in word]
    return hashlib.sha256(named + '\0'.join(flags).encode() + b'\0' + text.stdout).hexdigest()


def main():
    split = sys.argv.index('--')
    launcher, command = sys.argv[1:split], sys.argv[split + 1:]
    output = find_output(command)
    if output:
        pathlib.Path(f'{output}.sum').unlink(missing_ok=True)  # none is better than an old one
    done = subprocess.run([*launcher, *command], check=False)
    if done.returncode or not output:
        return done.returncode
    if written := checksum(command):
        pathlib.Path(f'{output}.sum').write_text(written + '\n', encoding='utf-8')
    return 0


if __name__ == '__main__':
    sys.exit(main())
