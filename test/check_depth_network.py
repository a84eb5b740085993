#!/usr/bin/env python3
"""Tests the module's sample correct_with_depth_network.py, with networks that are written here.

usage: check_depth_network.py ROOT PACKAGE_FOLDER SIMULATE_PROGRAM
"""

import os
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT, PACKAGE_FOLDER, SIMULATE_PROGRAM = map(os.path.abspath, sys.argv[1:])
sys.path[:0] = [os.path.join(ROOT, 'test', 'samples'), os.path.join(ROOT, 'modules', 'rsackermann', 'samples'),
                PACKAGE_FOLDER]

import correct_with_depth_network  # pylint: disable=wrong-import-position
import cv2  # pylint: disable=wrong-import-position
import numpy  # pylint: disable=wrong-import-position
import onnx_networks  # pylint: disable=wrong-import-position

SIZE = WIDTH, HEIGHT = 640, 380
FOCAL, READ_OUT = 816, 1 / 75


class DepthNetwork(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        subprocess.run([SIMULATE_PROGRAM, '--output=street', '--depth', '--left=3.2', '--right=4', '--obstacles=15',
                        '--stagger=1.5'], cwd=cls.folder, check=True, stdout=subprocess.DEVNULL)
        metres = cv2.imread(os.path.join(cls.folder, 'street', 'rolling_depth.png'), cv2.IMREAD_UNCHANGED) / 256
        inverse = numpy.where(metres > 0, 40 / numpy.maximum(metres, 0.01), 0).astype('<f4')
        for name, depth in (('relative', inverse), ('mirrored', inverse[:, ::-1])):
            depth.tofile(os.path.join(cls.folder, 'depth.bin'))
            os.mkdir(os.path.join(cls.folder, name))
            onnx_networks.main(os.path.join(cls.folder, name), WIDTH, HEIGHT, os.path.join(cls.folder, 'depth.bin'))
        cls.image = cv2.imread(os.path.join(cls.folder, 'street', 'rolling.png'))
        cls.truth = cv2.imread(os.path.join(cls.folder, 'street', 'global.png'))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_sample(self, network, output, *images):
        return subprocess.run(
            [sys.executable, correct_with_depth_network.__file__, *(images or ('street/rolling.png',)),
             '--model', network + '.onnx', '--output', output, '--input_size', str(WIDTH), str(HEIGHT),
             '--focal', str(FOCAL), '--line_delay', str(READ_OUT / HEIGHT), '--speed', '60', '--yaw_rate', '40'],
            cwd=self.folder, env=dict(os.environ, PYTHONPATH=PACKAGE_FOLDER), stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, universal_newlines=True, check=False)

    def difference(self, name):
        """From the image without rolling shutter, away from the borders."""
        image = cv2.imread(os.path.join(self.folder, name))
        return numpy.abs(image.astype(int) - self.truth)[20:-20, 20:-20].mean()

    def test_output(self):
        network = correct_with_depth_network.read_network(os.path.join(self.folder, 'relative', 'sum.onnx'))
        size, mean, deviations = correct_with_depth_network.NETWORKS['depth_anything']
        self.assertEqual(518, size)
        output = correct_with_depth_network.network_output(network, self.image, SIZE, mean,
                                                           [1 / deviation for deviation in deviations])
        values = (self.image[:, :, ::-1] - numpy.array(mean)) / deviations
        expected = values @ numpy.array(onnx_networks.WEIGHTS) + onnx_networks.BIAS
        self.assertLess(numpy.abs(output - expected).max(), 1e-4)

    def test_depth_is_used(self):
        self.assertEqual(0, self.run_sample('mirrored/given', 'mirrored.png').returncode)
        result = self.run_sample('relative/given', 'used.png')
        self.assertEqual(0, result.returncode, result.stderr)
        self.assertIn('depth used: inverse depth', result.stdout)
        self.assertLess(self.difference('used.png'), self.difference('mirrored.png'))

    def test_depth_that_contradicts(self):
        for network in ('mirrored/given', 'relative/constant'):
            result = self.run_sample(network, 'contradicts_%s.png' % network.split('/')[1])
            self.assertEqual(0, result.returncode, result.stderr)
            self.assertIn('depth not used', result.stdout)

    def test_wrong_networks(self):
        with open(os.path.join(self.folder, 'text.onnx'), 'w', encoding='utf-8') as file:
            file.write('no network')
        for network in ('text', 'missing', 'relative/cut', 'relative/one_number', 'relative/two_channels',
                        'relative/two_inputs', 'relative/two_outputs', 'relative/unknown_operator'):
            result = self.run_sample(network, 'wrong.png')
            self.assertEqual(1, result.returncode, network)
            self.assertIn(network + '.onnx', result.stderr)
            self.assertNotIn('Traceback', result.stderr)
            self.assertFalse(os.path.exists(os.path.join(self.folder, 'wrong.png')), network)

    def test_bad_image_among_others(self):
        with open(os.path.join(self.folder, 'bad.png'), 'w', encoding='utf-8') as file:
            file.write('no image')
        result = self.run_sample('relative/given', 'out/', 'bad.png', 'missing.png', 'street/rolling.png')
        self.assertEqual(1, result.returncode)
        self.assertIn('\nmissing.png: ', '\n' + result.stderr)
        self.assertIn('bad.png: ', result.stderr)
        self.assertEqual(['rolling.png'], os.listdir(os.path.join(self.folder, 'out')))

    def test_existing_files_stay(self):
        for name in ('street/rolling.png', 'relative/given.onnx'):
            with open(os.path.join(self.folder, name), 'rb') as file:
                before = file.read()
            result = self.run_sample('relative/given', name)
            self.assertEqual(1, result.returncode)
            self.assertIn(name + ' exists', result.stderr)
            with open(os.path.join(self.folder, name), 'rb') as file:
                self.assertEqual(before, file.read())


if __name__ == '__main__':
    unittest.main(argv=['unittest', '-v'])
