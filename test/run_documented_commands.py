#!/usr/bin/env python3
"""Runs the commands that README, doc/ and the tutorials print, on small rendered inputs.

A command is a line of a block of the language sh, or of an indented block unless that is output, whose first word ends
with a colon. The commands of a block run one after another in a folder with the inputs that the documents speak of.
What isn't run is in NOT_RUN with its reason; an entry there that no document has is an error, too.

usage: run_documented_commands.py ROOT BUILD
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'samples'))
import onnx_networks  # pylint: disable=wrong-import-position

# Commands, or with a space at the end beginnings of commands.
NOT_RUN = {
    'test/run_tests.sh': 'is what runs this test',
    'test/run_everything.sh': 'an hour; goes on after test/run_tests.sh',
    'cmake ': 'builds the project or OpenCV: the tests, scripts/test_package.sh and the test of Doxygen do it',
    'build/samples/rsackermann_live ': 'shows a window; test_live.cpp has it make a file',
    'colmap ': 'a program of others; what it reads is tested by test_export.cpp',
    'perf/experiments/reproduce_paper.sh ': 'minutes; test_reproduction.py runs it with --quick',
    'perf/experiments/reconstruct.sh ': 'an hour with COLMAP; check_reconstruction.py tests what it makes of its models',
    'perf/experiments/run_experiments.sh ': 'an hour; the experiment that it calls is run',
    'perf/experiments/plot_focal_error.sh ': 'minutes; the experiment that it calls is run',
    'build/perf/experiments/rsackermann_experiment_drives ': 'needs drives that aren\'t part of the project',
    'build/perf/experiments/rsackermann_experiment_alike ': 'needs drives that aren\'t part of the project',
    'build/perf/experiments/rsackermann_experiment_frames ': 'needs frames that aren\'t part of the project',
    'build/perf/benchmark/rsackermann_benchmark': 'minutes; that with a filter is run',
    'build/opencv_perf_rsackermann ': 'minutes; a test of its own runs it with one sample',
    'python3 "$(scripts/get_opencv_source.sh)"/modules/ts/misc/summary.py ':
        'fetches the source of OpenCV to compare two long runs',
    'python3 correct_with_depth_network.py ': 'check_depth_network.py runs it with Python\'s packages',
    'test/trust/faults.py ': 'a test of its own',
    'test/check_shards.py ': 'a test of its own',
    'scripts/get_opencv_source.sh': 'goes before pip, which test/check_wheel.py runs',
    'python3 -m venv ': 'goes before pip, which test/check_wheel.py runs',
    'build/venv/bin/pip ': 'minutes without ccache; test/check_wheel.py runs it',
    'build/venv/bin/python ': 'goes after pip, test/check_wheel.py runs it',
    'test/fuzz/run.sh ': 'builds everything with clang; minutes',
    'test/analyse.sh --tidy': 'installs tools; minutes',
    'test/sanitize.sh': 'builds everything with clang; minutes',
    'valgrind ': 'minutes',
    'test/coverage.sh': 'builds everything once more; minutes',
}

# What is replaced in commands.
REPLACED = {
    'samples/run_demo.sh': 'samples/demo.sh build demo',  # without installing and building
    'host1,host2': ':',  # the machine itself
    'rsackermann_benchmark --filter=solver': 'rsackermann_benchmark --filter=solver --rounds=1',
    'rsackermann_experiment_streets --': 'rsackermann_experiment_streets --scenes=1 --speeds=60 --yaw_rates=30 --',
    'rsackermann_experiment_depth --depth': 'rsackermann_experiment_depth --streets=1 --depth',
    '--streets=24': '--streets=1',
    'rsackermann_experiment_harm': 'rsackermann_experiment_harm --frames=10',
    'rsackermann_experiment_calibration': 'rsackermann_experiment_calibration --drives=1 --frames=60',
    # Of tests that ctest runs in full: one of each.
    'CorrectSequence.*:VideoTimes.*:*VideoIndex.*': 'CorrectSequence.number*:VideoTimes.rate*',
    '*Symmetry*:*SequenceModes*:*CalibrationModes*': 'EstimatorSymmetry.*:*SequenceModes.gravity*',
    '*CorrectorState*': '*CorrectorState.clock*',
    '*InputsStay*': 'InputsStay.options_are_known',
    '*OptionEffects*': 'OptionEffects.of_the_modes',
    'Contradictions.*:Correct.given_values*': 'Correct.given_values*',
    'Export.report*:Export.options_that_contradict*:Export.maps_that_follow*': 'Export.maps_that_follow*',
}

# What the documents take for granted, unless the same block makes it by this program.
MADE_BY = {'report.jsonl': 'rsackermann_correct', 'calibrated.yml': 'rsackermann_calibrate'}

FRAMES = 12
SIZE = (480, 300)
LINE_DELAY = 0.025 / SIZE[1]


def make_inputs(folder):
    """street.jpg, frames/ with images and depth/ with theirs, drive/ with frames that are 1/30 s apart, drive.csv, camera.yml,
    cloud.csv with points of a frame, network.onnx, and what is in MADE_BY."""
    def render(name, *options):
        subprocess.run(['rsackermann_simulate', '--output=one', '--overwrite', '--size=%dx%d' % SIZE, '--focal=400',
                        '--line_delay=%r' % LINE_DELAY, '--left=6', '--right=7', '--speed=36', '--yaw_rate=12',
                        '--samples=1', *options], check=True, cwd=folder)
        os.rename(os.path.join(folder, 'one', 'rolling.png'), os.path.join(folder, name))

    for name in ('frames', 'depth', 'drive'):
        os.mkdir(os.path.join(folder, name))
    for i in range(FRAMES):
        # A line far before or behind the image: the car is seen that much later or earlier.
        line = (SIZE[1] - 1) / 2 - (i - FRAMES // 2) / 30 / LINE_DELAY
        render('drive/%03d.png' % i, '--reference=%r' % line)
    for i in range(2):
        render('frames/%04d.png' % i, '--seed=%d' % i, '--depth')
        os.rename(os.path.join(folder, 'one', 'rolling_depth.png'), os.path.join(folder, 'depth', '%04d.png' % i))
    os.rename(os.path.join(folder, 'one', 'camera.yml'), os.path.join(folder, 'camera.yml'))
    shutil.rmtree(os.path.join(folder, 'one'))
    with open(os.path.join(folder, 'drive.csv'), 'w', encoding='utf-8') as file:
        file.write('frame,time_s,speed_kmh,yaw_rate_deg_s\n')
        file.writelines('%d,%r,36,12\n' % (i, i / 30) for i in range(FRAMES))
    with open(os.path.join(folder, 'cloud.csv'), 'w', encoding='utf-8') as file:
        file.write('file,x,y,z\n0001.png,-1,0.5,8\n')
    with open(os.path.join(folder, 'network.onnx'), 'wb') as file:
        file.write(onnx_networks.sum_of_channels(onnx_networks.WEIGHTS, onnx_networks.BIAS, (256, 256)))
    shutil.copy(os.path.join(folder, 'frames', '0000.png'), os.path.join(folder, 'street.jpg'))
    shutil.copy(os.path.join(folder, 'camera.yml'), os.path.join(folder, 'calibrated.yml'))
    subprocess.run(['rsackermann_correct', 'frames', '--camera=camera.yml', '--report=report.jsonl'],
                   check=True, cwd=folder)


def blocks_of(path):
    """The commands of each block, without comments."""
    with open(path, encoding='utf-8') as file:
        text = file.read()
    blocks = re.findall(r'^```sh\n(.*?)^```', text, re.M | re.S)
    if path.endswith('.md'):  # elsewhere they are parts of lists
        blocks += re.findall(r'\n\n((?: {4}(?!\S+: ).*\n)+)', re.sub(r'^```.*?^```', '', text, flags=re.M | re.S))
    for block in blocks:
        lines = [re.sub(r'(^|\s)#.*', '', line).strip() for line in block.replace('\\\n', ' ').splitlines()]
        yield [line for line in lines if line]


def reasons(command):
    """Entries of NOT_RUN for the command."""
    return [entry for entry in NOT_RUN if command == entry or entry.endswith(' ') and command.startswith(entry)]


def run(command, folder):
    for old, new in REPLACED.items():
        command = command.replace(old, new)
    result = subprocess.run(['bash', '-euc', command], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, check=False)
    return ('' if result.returncode == 0 else
            '`%s` ended with %d: %s' % (command, result.returncode, result.stdout[-2000:]))


def run_block(commands, prepared, folder, root, build):
    """The first problem, or ''."""
    shutil.copytree(prepared, folder)
    for name, program in MADE_BY.items():
        if any(program in command for command in commands):
            os.remove(os.path.join(folder, name))
    os.symlink(build, os.path.join(folder, 'build'))
    os.symlink(os.path.join(root, 'samples'), os.path.join(folder, 'samples'))
    for command in commands:
        problem = run(command, folder)
        if problem:
            return problem
    return ''


def main(root, build):
    root, build = os.path.abspath(root), os.path.abspath(build)
    os.environ['PATH'] = os.path.join(build, 'samples') + os.pathsep + os.environ['PATH']
    os.environ.update(SLURM_ARRAY_TASK_ID='1', SLURM_ARRAY_TASK_COUNT='2')
    paths = [os.path.join(root, 'README.md')] + sorted(glob.glob(os.path.join(root, 'doc', '*.md')))
    paths += sorted(glob.glob(os.path.join(root, 'modules', '*', 'tutorials', '**', '*.markdown'), recursive=True))
    problems, used, count = [], set(), 0
    with tempfile.TemporaryDirectory() as work:
        prepared = os.path.join(work, 'prepared')
        os.mkdir(prepared)
        make_inputs(prepared)
        for path in paths:
            for number, commands in enumerate(blocks_of(path)):
                used.update(entry for command in commands for entry in reasons(command))
                commands = [command for command in commands if not reasons(command)]
                count += len(commands)
                problem = run_block(commands, prepared,
                                    os.path.join(work, '%s.%d' % (os.path.basename(path), number)), root, build)
                if problem:
                    problems.append('%s: %s' % (os.path.relpath(path, root), problem))
    problems += ['NOT_RUN has "%s", which no document has' % entry for entry in NOT_RUN if entry not in used]
    print('%d commands' % count)
    for problem in problems:
        print(problem)
    return 1 if problems or not count else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
