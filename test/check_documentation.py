#!/usr/bin/env python3
"""Checks what the documentation says about files and options that change with the code.

- Relative links in the Markdown files lead to files and sections that exist.
- A code block after <!-- snippet: FILE NAME --> is the part of that file between the lines with [NAME].
- The tables of options in doc/cli.md have the options of the programs, in any order.
- Sections of doc/theory.md that the code cites exist.
- Its table of constants has the values of the code, and all constants in capitals that are single numbers of the
  folders of src that make estimates, but for those that are computed from others.

usage: check_documentation.py ROOT PROGRAM...
"""

import os
import re
import subprocess
import sys

SOURCES = ('.cpp', '.hpp', '.cl', '.py')
ESTIMATING = ('calibration', 'factors', 'features', 'motion', 'optim', 'scene', 'sequence', 'single')


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def files_in(root, folders, endings):
    for folder in folders:
        for directory, _, names in os.walk(os.path.join(root, folder)):
            for name in sorted(names):
                if name.endswith(endings):
                    yield os.path.join(directory, name)


def without_indentation(text):
    lines = text.strip('\n').split('\n')
    indentation = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    return [line[indentation:].rstrip() for line in lines]


def sections_of(text):
    """Titles of the sections, and the anchors that GitHub makes of them."""
    titles = re.findall(r'^#+ +(.*?) *$', re.sub(r'```.*?```', '', text, flags=re.S), re.M)
    return titles, [re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-') for title in titles]


def check_links(path, problems):
    text = re.sub(r'```.*?```|`[^`]*`', '', read(path), flags=re.S)
    for target in re.findall(r'\]\(([^)\s]+)\)', text) + re.findall(r'<img [^>]*src="([^"]+)"', text):
        if '://' in target:
            continue
        name, _, anchor = target.partition('#')
        linked = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
        if not os.path.exists(linked):
            problems.append('%s: the link %s leads nowhere' % (path, target))
        elif anchor and anchor not in sections_of(read(linked))[1]:
            problems.append('%s: the link %s leads to no section' % (path, target))


def check_snippets(root, path, problems):
    blocks = re.findall(r'<!-- snippet: (\S+) (\S+) -->\n+```\w*\n(.*?)```', read(path), re.S)
    for source, name, block in blocks:
        parts = re.split(r'^.*\[%s\] *\n' % re.escape(name), read(os.path.join(root, source)), flags=re.M)
        if len(parts) != 3 or without_indentation(parts[1]) != without_indentation(block):
            problems.append('%s: the snippet isn\'t the part [%s] of %s' % (path, name, source))
    return len(blocks)


def check_options(page, program, problems):
    help_text = subprocess.run([program, '--help'], stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout
    known = set(re.findall(r'^\s+--(\w+)', help_text, re.M)) - {'help'}
    table = re.search(r'<!-- options of %s -->(.*?)\n\n' % os.path.basename(program), read(page), re.S)
    described = set(re.findall(r'`--(\w+)', ''.join(
        row.split('|')[1] for row in re.findall(r'^\|.*$', table.group(1), re.M))))
    for option in sorted(known - described):
        problems.append('%s: the option --%s of %s isn\'t described' % (page, option, os.path.basename(program)))
    for option in sorted(described - known):
        problems.append('%s: %s has no option --%s' % (page, os.path.basename(program), option))


def check_citations(root, problems):
    titles = sections_of(read(os.path.join(root, 'doc', 'theory.md')))[0]
    for path in files_in(root, ['modules', 'samples', 'perf', 'test'], SOURCES):
        for section in re.findall(r'doc/theory\.md,\s+(?:(?://|\*|#)\s*)?"([^"]+)"', read(path)):
            if section not in titles:
                problems.append('%s: doc/theory.md has no section "%s"' % (path, section))


def check_constants(root, problems):
    sources = os.path.join(root, 'modules', 'rsackermann', 'src')
    theory = os.path.join(root, 'doc', 'theory.md')
    table = read(theory).split('\n## Constants\n')[1].split('\n## ')[0]
    described = set()
    for source, name, value in re.findall(r'^\| `([^`]+)` \| `(\w+)` \| ([^|]+) \|', table, re.M):
        described.add((source, name))
        if not re.search(r'\b%s = %s[,;]' % (name, re.escape(value)), read(os.path.join(sources, source))):
            problems.append('%s: %s isn\'t %s in %s' % (theory, name, value, source))
    for path in files_in(sources, ESTIMATING, ('.cpp', '.hpp')):
        source = os.path.relpath(path, sources)
        for declaration in re.findall(r'^(?:static )?const (?:double|size_t|int) ([^;{]*);', read(path), re.M):
            for name, value in re.findall(r'\b([A-Z][A-Z_]+) = ([^,]*)', declaration):
                is_computed = re.search(r'\b(?!CV_PI)[A-Za-z_]{2}', value)
                if not is_computed and (source, name) not in described:
                    problems.append('%s: the table of constants hasn\'t %s of %s' % (theory, name, source))


def main(root, *programs):
    pages = [os.path.join(root, name) for name in ('README.md', 'CONTRIBUTING.md', 'CHANGELOG.md')]
    problems = []
    snippets = 0
    for path in pages + list(files_in(root, ['doc', 'modules', 'samples'], ('.md', '.markdown'))):
        check_links(path, problems)
        snippets += check_snippets(root, path, problems)
    if snippets == 0:
        problems.append('there are no snippets')
    for program in programs:
        check_options(os.path.join(root, 'doc', 'cli.md'), program, problems)
    check_citations(root, problems)
    check_constants(root, problems)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
