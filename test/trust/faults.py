#!/usr/bin/env python3
"""What rsackermann_correct leaves behind when something goes wrong, compared with an undisturbed run.

- Killed: two shards with a common report are killed (SIGKILL) at random moments and go on with --skip_existing; \
whatever is visible after a
  kill is complete, and in the end everything is as if nothing had happened.
- A full disk (a small tmpfs, or without the right to mount one a limit on the size of files): exit code 1, \
nothing incomplete, and
  with room again the rest is done.
- A folder that can't be written, an input that vanishes while the program runs.

usage: faults.py FOLDER_OF_PROGRAMS [--moments=200] [--seed=1]
Exit code: 0 if all is as it should be.
"""

import argparse
import contextlib
import hashlib
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

IMAGES = 16
RESULTS = ('o', 'v', 'm')


class Fault(Exception):
    """Something isn't as it should be."""


def require(condition, message):
    if not condition:
        raise Fault(message)


def make_inputs(simulate, folder):
    folder.mkdir()
    for i in range(IMAGES):
        one = folder / 'one'
        subprocess.run([simulate, '--output=%s' % one, '--size=160x96', '--focal=204', '--samples=1',
                        '--seed=%d' % i, '--overwrite'], check=True)
        (one / 'rolling.png').rename(folder / ('%02d.png' % i))
    shutil.rmtree(folder / 'one')
    broken = folder / '07.png'
    broken.write_bytes(broken.read_bytes()[:2000])


def command(correct, inputs, out, *more):
    return [correct, str(inputs), '--output=%s' % (out / 'o'), '--overlay=%s' % (out / 'v'), '--maps=%s' % (out / 'm'),
            '--report=%s' % (out / 'report.jsonl'), '--threads=1', *more]


def report_of(out, whole=True):
    """The lines without times of computing, sorted; a last line that was cut by a kill doesn't count."""
    path = out / 'report.jsonl'
    text = path.read_text() if path.exists() else ''
    require(not whole or text.endswith('\n'), 'the report ends within a line')
    lines = []
    for line in text[:text.rfind('\n') + 1].splitlines():
        values = json.loads(line)
        lines.append(json.dumps({k: v for k, v in values.items() if not k.startswith('ms_')}, sort_keys=True))
    return sorted(lines)


def files_of(out, hidden=True):
    return {str(path.relative_to(out)): hashlib.sha256(path.read_bytes()).hexdigest()
            for folder in RESULTS for path in sorted((out / folder).glob('*'))
            if hidden or not path.name.startswith('.')}


def require_part_of(out, reference, lines):
    """What is visible is complete and right."""
    for name, content in files_of(out, hidden=False).items():
        require(reference.get(name) == content, '%s is not what it should be' % name)
    present = report_of(out, whole=False)
    require(len(set(present)) == len(present), 'a line of the report is there twice')
    require(set(present) <= set(lines), 'the report has a line that it should not have')


def require_equal(out, reference, lines):
    require(files_of(out) == reference, 'the files differ from those of an undisturbed run: %s' %
            sorted(set(files_of(out)) ^ set(reference)))
    require(report_of(out) == lines, 'the report differs from that of an undisturbed run')


def wait_for_work(processes, out):
    """Until something new is in the folder or a program has ended."""
    def names():
        return {path.name for folder in RESULTS for path in (out / folder).glob('*')}
    before = names()
    while names() == before and all(process.poll() is None for process in processes):
        time.sleep(0.0005)


def killed(correct, inputs, out, reference, lines, moments, rng):
    quiet = {'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL}
    shards = [command(correct, inputs, out, '--shard=%d/2' % i, '--skip_existing') for i in (1, 2)]
    begin = time.monotonic()
    for process in [subprocess.Popen(shard, **quiet) for shard in shards]:
        process.wait()
    duration = time.monotonic() - begin
    require_equal(out, reference, lines)
    kills = within = rounds = 0
    while kills < moments:
        shutil.rmtree(out)
        finished = False
        while not finished:
            processes = [subprocess.Popen(shard, **quiet) for shard in shards]
            if kills < moments:
                if rng.random() < 0.9: # the others are killed while they start
                    wait_for_work(processes, out)
                for process in processes:
                    time.sleep(rng.uniform(0, duration / 4))
                    if process.poll() is None:
                        process.send_signal(signal.SIGKILL)
                        kills += 1
            codes = [process.wait() for process in processes]
            finished = all(code >= 0 for code in codes)
            require_part_of(out, reference, lines)
            within += 0 < len(files_of(out, hidden=False)) < len(reference)
        require(sorted(codes) == [0, 1], 'exit codes %s' % codes)
        require_equal(out, reference, lines)
        rounds += 1
    require(within > 0, 'no kill has met a batch at work')
    return '%d kills in %d batches, %d times with a part of the results there' % (kills, rounds, within)


@contextlib.contextmanager
def small_disk(folder, options):
    """A tmpfs, if it may be mounted."""
    folder.mkdir()
    mounted = subprocess.run(['mount', '-t', 'tmpfs', '-o', options, 'tmpfs', str(folder)],
                             stderr=subprocess.DEVNULL, check=False).returncode == 0
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(['umount', str(folder)], check=True)


def full_disk(correct, inputs, out, reference, lines):
    with small_disk(out, 'size=600k') as mounted:
        # Without a tmpfs no file can have more than 40 kB: overlays and reports, but no maps.
        limit = None if mounted else lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40000, 40000))
        done = subprocess.run(command(correct, inputs, out), stderr=subprocess.PIPE, universal_newlines=True,
                              preexec_fn=limit, check=False)
        require(done.returncode == 1, 'exit code %d' % done.returncode)
        require("can't be written" in done.stderr, done.stderr)
        require(not [name for name in files_of(out) if '/.' in name], 'a temporary file is left')
        count = len(files_of(out))
        require(count < len(reference), 'the disk had room for everything')
        present = {name: content for name, content in files_of(out).items()}
        require(all(reference[name] == content for name, content in present.items()), 'a file is not what it should be')
        report_of(out)
        if mounted:
            subprocess.run(['mount', '-o', 'remount,size=100m', str(out)], check=True)
        done = subprocess.run(command(correct, inputs, out, '--skip_existing'), stderr=subprocess.DEVNULL, check=False)
        require(done.returncode == 1, 'exit code %d with room again' % done.returncode)  # one image is broken
        require_equal(out, reference, lines)
    return '%d of %d files had room, %s' % (count, len(reference), 'tmpfs' if mounted else 'limit on the size of files')


def read_only_folder(correct, inputs, out):
    with small_disk(out, 'size=1m,ro') as mounted:
        if not mounted:
            out.chmod(0o555)
        done = subprocess.run(command(correct, inputs, out), stderr=subprocess.PIPE, universal_newlines=True,
                              check=False)
        require(done.returncode == 1, 'exit code %d' % done.returncode)
        require("can't be" in done.stderr, done.stderr)
        require(not list(out.iterdir()), 'something was written')
    return 'nothing written'


def vanished_input(correct, inputs, out, reference):
    copy = out.parent / 'copy'
    shutil.copytree(inputs, copy)
    process = subprocess.Popen(command(correct, copy, out), stderr=subprocess.PIPE, universal_newlines=True)
    while not (out / 'report.jsonl').exists():
        time.sleep(0.001)
    last = copy / ('%02d.png' % (IMAGES - 1))
    last.unlink()
    messages = process.communicate()[1]
    require(process.returncode == 1, 'exit code %d' % process.returncode)
    require(last.name in messages, messages)
    expected = {name: content for name, content in reference.items()
                if pathlib.Path(name).name.split('.')[0] != last.stem}
    require(files_of(out) == expected, 'the others are not all there')
    failed = [json.loads(line) for line in report_of(out) if json.loads(line)['status'] == 'failed']
    require(sorted(pathlib.Path(line['input']).name for line in failed) == ['07.png', last.name],
            'the failures in the report are others')
    return 'the others are done'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('programs')
    parser.add_argument('--moments', type=int, default=200)
    parser.add_argument('--seed', type=int, default=1)
    arguments = parser.parse_args()
    correct = os.path.abspath(os.path.join(arguments.programs, 'rsackermann_correct'))
    simulate = os.path.abspath(os.path.join(arguments.programs, 'rsackermann_simulate'))
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        base = pathlib.Path(name)
        inputs, undisturbed = base / 'in', base / 'undisturbed'
        make_inputs(simulate, inputs)
        done = subprocess.run(command(correct, inputs, undisturbed), stderr=subprocess.DEVNULL, check=False)
        reference, lines = files_of(undisturbed), report_of(undisturbed)
        require(done.returncode == 1 and len(reference) == 3 * (IMAGES - 1) and len(lines) == IMAGES,
                'the undisturbed run has failed')
        rng = random.Random(arguments.seed)
        for title, check in (('killed', lambda: killed(correct, inputs, base / 'killed', reference, lines,
                                                       arguments.moments, rng)),
                             ('full disk', lambda: full_disk(correct, inputs, base / 'full', reference, lines)),
                             ('read-only folder', lambda: read_only_folder(correct, inputs, base / 'read_only')),
                             ('vanished input', lambda: vanished_input(correct, inputs, base / 'vanished', reference))):
            try:
                print('%s: ok, %s' % (title, check()), flush=True)
            except Fault as fault:
                print('%s: FAILED, %s' % (title, fault), flush=True)
                failures += 1
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())
