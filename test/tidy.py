#!/usr/bin/env python3
"""Runs clang-tidy, by .clang-tidy, on sources that a build compiles; prints what it finds and fails if there is
anything.

usage: tidy.py BUILD CACHE SOURCE...

BUILD has a compile_commands.json. A source in which nothing was found isn't looked at again until what the preprocessor
makes of it changes, or clang-tidy or .clang-tidy does: for that the folder CACHE gets an empty file with the hash of
these.

Findings whose place is in a header of the system don't count: clang-tidy shows them if their path begins in a source.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys


def preprocessed(command, directory):
    words = shlex.split(command)
    end = words.index('-o')
    # With comments, as those of clang-tidy are among them.
    return subprocess.run(words[:end] + ['-E', '-C', '-P'] + words[end + 2:],
                          cwd=directory, check=True, stdout=subprocess.PIPE).stdout


def findings(output, folder):
    """The findings of clang-tidy, each with its notes, whose place is in a folder or has no file."""
    heads = list(re.finditer(r'^(?:(/[^:\n]+):\d+:\d+: )?(?:warning|error|fatal error): .*$', output, re.M))
    ends = [match.start() for match in heads[1:]] + [len(output)]
    return ''.join(output[head.start():end] for head, end in zip(heads, ends)
                   if not head[1] or pathlib.Path(os.path.realpath(head[1])).is_relative_to(folder))


def main():
    build, cache = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    sources = [os.path.realpath(source) for source in sys.argv[3:]]
    commands = {entry['file']: entry for entry in json.loads((build / 'compile_commands.json').read_text())}
    missing = [source for source in sources if source not in commands]
    if missing:
        sys.exit('not part of the build: ' + ', '.join(missing))
    cache.mkdir(parents=True, exist_ok=True)
    common = pathlib.Path('.clang-tidy').read_bytes() + subprocess.check_output(['clang-tidy', '--version'])

    def look(source):
        entry = commands[source]
        key = cache / hashlib.sha256(common + preprocessed(entry['command'], entry['directory'])).hexdigest()
        if key.exists():
            return 0, ''
        result = subprocess.run(['clang-tidy', '--quiet', '-p', str(build), source],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        found = findings(result.stdout, pathlib.Path.cwd())
        if result.returncode and not result.stdout:  # it didn't run
            found = result.stderr or f'clang-tidy failed on {source}\n'
        if not found:
            key.touch()
        return 1, found

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(look, sources))
    found = ''.join(text for _, text in results)
    print(f'{sum(looked for looked, _ in results)} of {len(sources)} sources looked at, the others haven\'t changed')
    if found:
        sys.exit(found)


if __name__ == '__main__':
    main()
