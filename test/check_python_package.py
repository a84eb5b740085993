#!/usr/bin/env python3
"""Runs the module's Python test with the package rsackermann beside the installed cv2, which doesn't know the module.

What the package has of its own, since its types aren't those of cv2, takes the place of cv2's; images and results go
from one to the other.

usage: check_python_package.py PACKAGE_FOLDER OPENCV_SOURCE TEST_FOLDER
"""

import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path[:0] = [sys.argv[1], os.path.join(sys.argv[2], 'modules', 'python', 'test')]

import cv2  # pylint: disable=wrong-import-position
import rsackermann  # pylint: disable=wrong-import-position

if hasattr(cv2, 'rsackermann'):
    sys.exit('%s has the module itself' % cv2.__file__)
cv2.rsackermann = rsackermann
cv2.FileStorage, cv2.error = rsackermann.FileStorage, rsackermann.error
unittest.main(module=None, argv=['unittest', 'discover', '-v', '-s', sys.argv[3]])
