#!/usr/bin/env python3
"""Tests the module's sample correct_with_depth_network.py, with networks that are written here.

usage: check_depth_network.py ROOT PACKAGE_FOLDER SIMULATE_PROGRAM
"""

import contextlib
import io
import os
import re
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

    def result(self, network, *options):
        """The image and what is said of the depth; of an option that is there twice the last one counts."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            status = correct_with_depth_network.main(
                [os.path.join(self.folder, 'street', 'rolling.png'), '--model', os.path.join(self.folder, network),
                 '--output', os.path.join(self.folder, 'option.png'), '--input_size', str(WIDTH), str(HEIGHT),
                 '--focal', str(FOCAL), '--line_delay', str(READ_OUT / HEIGHT), *options])
        self.assertEqual(0, status)
        image = cv2.imread(os.path.join(self.folder, 'option.png'))
        os.remove(os.path.join(self.folder, 'option.png'))
        return image.tobytes(), said.getvalue()

    def test_each_option_has_an_effect(self):
        given, summed = 'relative/given.onnx', 'relative/sum.onnx'
        table = {'model': (given, os.path.join(self.folder, summed)), 'network': (summed, 'dpt'),
                 'input_size': (summed, '320', '190'), 'mean': (summed, '1', '2', '3'), 'scale': (summed, '1', '2', '3'),
                 'bgr': (summed,), 'depth_kind': (given, 'metric'), 'focal': (given, '700'),
                 'line_delay': (given, '5e-5'), 'speed': (given, '40'), 'yaw_rate': (given, '20'), 'wall': (given, '2')}
        shown = io.StringIO()
        with contextlib.redirect_stdout(shown), self.assertRaises(SystemExit):
            correct_with_depth_network.main(['--help'])
        self.assertEqual(set(table) | {'help', 'output'}, set(re.findall('--([a-z_]+)', shown.getvalue())))
        plain = {network: self.result(network) for network in (given, summed)}
        for name, (network, *values) in table.items():
            self.assertTrue(self.result(network, '--' + name, *values) != plain[network], name)

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
