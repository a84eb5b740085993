#!/usr/bin/env python3
"""Installs the Python package with pip by the README's commands, without network and in a copy of the checkout; then
makes a wheel, deletes the copy, and has another virtual environment run the module's Python test with the wheel.

Without OpenCV's source, pip has to fail and say how to get it.

usage: check_wheel.py ROOT OPENCV_SOURCE VERSION OPTION_OF_CMAKE...
"""

import glob
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

# What the installed package says of itself; nothing of the project may be loaded from anywhere else.
DESCRIBE = '''
import importlib.metadata
import rsackermann
print(importlib.metadata.version('rsackermann'))
print(rsackermann.__file__)
with open('/proc/self/maps', encoding='utf-8') as maps:
    print(*{line.split()[-1] for line in maps if 'rsackermann' in line.split()[-1]}, sep='\\n')
'''


def run(command, folder, environment):
    """What the command prints; ends the test if it fails."""
    result = subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, check=False)
    if result.returncode:
        sys.exit('%s ended with %d: %s' % (command, result.returncode, result.stdout[-10000:]))
    return result.stdout


def copy_checkout(root, target):
    shutil.copytree(root, target, ignore=lambda folder, names: [
        name for name in names if folder == root and (name == '.git' or name.startswith('build'))])


def commands_of_readme(root):
    with open(os.path.join(root, 'README.md'), encoding='utf-8') as file:
        return re.search(r'<!-- tested: pip -->\n```sh\n(.*?)```', file.read(), re.S).group(1)


def environment_of_build(checkout, options):
    """Without the settings of pip and Python that this machine has; python3 is the one that runs this test."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(('PIP_', 'PYTHON'))}
    environment.pop('OPENCV_TS_SOURCE_DIR', None)
    environment.update(PATH=os.path.dirname(sys.executable) + os.pathsep + os.environ['PATH'],
                       PIP_CONFIG_FILE=os.devnull, PIP_NO_INDEX='1', CMAKE_ARGS=shlex.join(options),
                       CCACHE_BASEDIR=checkout)
    return environment


def check_missing_source(checkout, work, environment):
    """Problems."""
    result = subprocess.run([sys.executable, '-m', 'pip', 'wheel', '--no-build-isolation', '--no-deps', '--wheel-dir=' + work, '.'],
                            cwd=checkout, env=dict(environment, XDG_CACHE_HOME=os.path.join(work, 'empty')),
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode and re.search(r'scripts/get_opencv_source\.sh\s+fetches\s+it', result.stdout):
        return []
    return ['without OpenCV\'s source pip ended with %d: %s' % (result.returncode, result.stdout)]


def check_installed(python, work, version):
    """Problems; and the folder that the package is in."""
    found, file, *loaded = run([python, '-I', '-c', DESCRIBE], work, None).split('\n')[:-1]
    prefix = os.path.dirname(os.path.dirname(python)) + os.sep
    problems = ['%s isn\'t below %s' % (path, prefix) for path in [file] + loaded if not path.startswith(prefix)]
    if found != version:
        problems.append('the wheel has version %s, CMake has %s' % (found, version))
    if not loaded:
        problems.append('no extension is loaded')
    return problems, os.path.dirname(os.path.dirname(file))


def main(root, opencv_source, version, *options):
    with tempfile.TemporaryDirectory() as work:
        work = os.path.realpath(work)
        checkout = os.path.join(work, 'checkout')
        copy_checkout(root, checkout)
        environment = environment_of_build(checkout, options)
        problems = check_missing_source(checkout, work, environment)
        run(['bash', '-euc', commands_of_readme(root)], checkout, environment)
        run(['build/venv/bin/pip', 'wheel', '--no-build-isolation', '--no-deps', '--wheel-dir=' + work, '.'],
            checkout, environment)
        shutil.rmtree(checkout)

        run([sys.executable, '-m', 'venv', '--system-site-packages', '--without-pip', 'other'], work, environment)
        python = os.path.join(work, 'other', 'bin', 'python')
        run([python, '-m', 'pip', 'install'] + glob.glob(os.path.join(work, '*.whl')), work, environment)
        more_problems, packages = check_installed(python, work, version)
        run([python, os.path.join(root, 'test', 'check_python_package.py'), packages, opencv_source,
             os.path.join(root, 'modules', 'rsackermann', 'misc', 'python', 'test')], work, environment)
    problems += more_problems
    print('\n'.join(problems) or 'the wheel works')
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
