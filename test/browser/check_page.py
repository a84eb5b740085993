#!/usr/bin/env python3
"""Opens pages of rsackermann_page in Chromium, as a reader does, and uses them by mouse and keyboard: in light and dark, with pictures
inside and beside, with ten thousand frames.

Without Chromium it says so and ends with status 77.
usage: check_page.py PROGRAM [FOLDER_FOR_SCREENSHOTS]
"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

from browser import Browser, find_chromium

RED, GREEN, BLUE = (220, 30, 30), (30, 180, 30), (30, 30, 220)
NAMES = ['<img src=x onerror=alert(1)>.png', '"a" & \'b\'.png', 'ö #%?&amp;.png'] + ['%03d.png' % i for i in range(3, 12)]
FAILED, UNKNOWN, LONG = 5, (7, 8), 10000


def write_image(path, colour):
    """A PNG of one colour."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    width, height = 320, 200
    with open(path, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 2, 0, 0, 0)) +
                   chunk(b'IDAT', zlib.compress((b'\0' + bytes(colour) * width) * height)) + chunk(b'IEND', b''))


def line_of(number, name):
    if number == FAILED:
        return {'input': name, 'status': 'failed', 'error': 'the image is </script> short'}
    known = number not in UNKNOWN
    line = {'input': name, 'time_s': number / 10, 'status': 'ok' if known else 'too_few_segments', 'model': '4la', 'segments': 40,
            'candidates': 20, 'inliers': 10, 'mean_shift_px': 2.5, 'contradicts_prior': False, 'scale': 'wall',
            'given_yaw_rate_deg_s': 11.0 if number % 3 == 0 else None, 'given_yaw_rate_sigma': 1.0 if number % 3 == 0 else None}
    line.update({key: value if known else None for key, value in {
        'yaw_rate_deg_s': 10.0 + number % 7, 'yaw_rate_sigma': 1.5, 'speed_km_h': 50.0, 'speed_sigma': 2.0, 'probability_worse': 0.01,
        'expected_px_raw': 3.0, 'expected_px_left': 0.2 + (number == 4)}.items()})
    return line


class PageTest(unittest.TestCase):
    program, screenshots = '', ''

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name
        for kind, colour in (('raw', RED), ('corrected', BLUE), ('overlay', GREEN)):
            os.mkdir(os.path.join(self.folder, kind))
            for name in NAMES:
                write_image(os.path.join(self.folder, kind, name), colour)
        self.browser = Browser()
        self.addCleanup(self.browser.__exit__)

    def make(self, *options, lines=None, name='drive "ö" #%?.html'):
        lines = lines or [line_of(i, 'raw/' + name) for i, name in enumerate(NAMES)]
        with open(os.path.join(self.folder, 'report.jsonl'), 'w', encoding='utf-8') as file:
            file.writelines(json.dumps(line) + '\n' for line in lines)
        subprocess.run([os.path.abspath(self.program), '--report=report.jsonl', '--output=' + name, *options], cwd=self.folder, check=True)
        self.browser.open(os.path.join(self.folder, name))

    def make_with_pictures(self, *options):
        self.make('--corrected=corrected', '--overlay=overlay', *options)

    def text(self, selector='body'):
        return self.browser.evaluate('document.querySelector(%s).innerText' % json.dumps(selector))

    def place_of(self, selector):
        return self.browser.evaluate('(r => [r.x, r.y, r.width, r.height])(document.querySelector(%s).getBoundingClientRect())' %
                                     json.dumps(selector))

    def colours(self, *shares):
        """Colours of the pictures at shares of their width, once they are decoded."""
        self.browser.evaluate('Promise.all([...document.images].filter(i => !i.hidden).map(i => i.decode())).then(() => 0)')
        x, y, width, height = self.place_of('#stack')
        return [self.browser.colour(x + share * width, y + height / 2) for share in shares]

    def assert_colours(self, expected, *shares):
        for colour, other in zip(self.colours(*shares), expected):
            self.assertLess(max(abs(a - b) for a, b in zip(colour, other)), 12, (colour, other))

    def keep_screenshot(self, name):
        if self.screenshots:
            with open(os.path.join(self.screenshots, name + '.png'), 'wb') as file:
                file.write(self.browser.picture())

    def tearDown(self):
        self.assertEqual([], self.browser.faults())

    def test_slider_and_segments(self):
        for options in ((), ('--embed=0', '--overwrite')):
            self.make_with_pictures(*options)
            self.assert_colours((RED, BLUE), 0.3, 0.7)
            self.browser.evaluate('document.querySelector("#cut").focus()')
            self.browser.press('Home')
            self.assert_colours((BLUE, BLUE), 0.3, 0.7)
            for _ in range(40):
                self.browser.press('ArrowRight')
            self.assert_colours((RED, BLUE), 0.3, 0.5)
            self.browser.press('b')
            self.assert_colours((RED, RED), 0.3, 0.9)
            x, y, width, height = self.place_of('#stack')
            self.browser.mouse('mousePressed', x + 0.1 * width, y + height / 2)
            self.browser.mouse('mouseMoved', x + 0.6 * width, y + height / 2)
            self.browser.mouse('mouseReleased', x + 0.6 * width, y + height / 2)
            self.assert_colours((RED, BLUE), 0.5, 0.7)
            self.browser.press('s')
            self.assert_colours((GREEN, BLUE), 0.3, 0.7)

    def test_names_and_words_of_frames(self):
        self.make_with_pictures()
        for name in NAMES:
            self.assertIn(name, self.text('h2'))
            self.browser.press('ArrowRight')
        self.assertIn('12 frames: 9 ok, 2 too_few_segments, 1 failed', self.text())
        self.browser.press('Home')
        self.assertIn('10.0 deg/s ± 3.0 (2 sigma)', self.text('dl'))
        self.assertIn('11.0 deg/s ± 2.0 (2 sigma)', self.text('dl'))
        for _ in range(FAILED):
            self.browser.press('ArrowRight')
        self.assertEqual(['status', 'failed', 'error', 'the image is </script> short'], self.text('dl').split('\n'))
        self.assertIn('corrected: no picture', self.text('#stack'))
        self.assert_colours((RED, RED), 0.3, 0.7)
        self.browser.press('ArrowRight')
        self.browser.press('ArrowRight')
        self.assertIn('too_few_segments', self.text('dl'))
        self.assertIn('unknown', self.text('dl'))

    def test_curves(self):
        self.make_with_pictures()
        self.assertEqual(['yaw rate (deg/s)', 'speed (km/h)', 'displacement (px)', 'status'], self.browser.evaluate(
            '[...document.querySelectorAll("svg text[transform]")].map(t => t.textContent)'))
        self.assertEqual(4, self.text('#charts').count('time (s)'))
        # The frames that failed and that are unknown are between three runs; each given value is alone.
        curves = self.browser.evaluate('[...document.querySelector("svg").querySelectorAll("g path")].map(p => p.getAttribute("d"))')
        self.assertEqual([3, 3, 0, 4], [curve.count('M') for curve in curves])
        self.assertNotIn('NaN', ''.join(curves))
        x, y, width, _ = self.place_of('svg')
        for number in (9, 2):
            place = 140 + (width - 20 - 140) * number / 11
            self.browser.click(x + place + 3, y + 60)
            self.assertIn('(%d of 12)' % (number + 1), self.text('h2'))
            line = self.browser.evaluate('document.querySelector(".cursor").getAttribute("d")')
            self.assertAlmostEqual(place, float(line[1:].split()[0]), delta=1)

    def test_worst_first(self):
        self.make_with_pictures()
        self.browser.press('w')
        for number in (FAILED, *UNKNOWN, 4):
            self.assertIn('(%d of 12)' % (number + 1), self.text('h2'))
            self.browser.press('ArrowRight')
        self.browser.press('ArrowLeft')
        self.browser.press('w')
        self.assertIn('(5 of 12)', self.text('h2'))

    def test_light_and_dark(self):
        self.make_with_pictures()
        for scheme, is_dark in (('light', False), ('dark', True)):
            self.browser.set_scheme(scheme)
            self.assertEqual(is_dark, sum(self.browser.colour(3, 3)) < 150)
            ink = self.browser.evaluate('getComputedStyle(document.querySelector("svg text")).fill.match(/\\d+/g).map(Number)')
            self.assertEqual(is_dark, sum(ink) > 600)
            self.keep_screenshot('page_' + scheme)

    def test_all_that_can_be_focused_shows_it(self):
        self.make_with_pictures()
        reached = set()
        for _ in range(8):
            self.browser.press('Tab')
            reached.add(self.browser.evaluate('getComputedStyle(document.activeElement).outlineStyle === "solid" && document.activeElement.id'))
        self.assertLessEqual({'cut', 'previous', 'place', 'next', 'segments', 'worst', 'near'}, reached)

    def test_without_times_and_results(self):
        lines = [line_of(i, 'raw/003.png') for i in (0, 1)]
        for i, line in enumerate(lines):
            line.update(frame=i, input='missing.avi', status='failed')
            del line['time_s']
        self.make(lines=lines)
        self.assertIn('missing.avi, frame 0 (1 of 2)', self.text('h2'))
        self.assertNotIn('time (s)', self.text('#charts'))
        self.assertIn('raw: no picture', self.text('#stack'))

    def test_lines_of_shards_and_a_single_frame(self):
        numbers = [0, 2, 4, 1, 3]
        self.make(lines=[line_of(i, 'raw/003.png') | {'input': 'raw/%03d.png' % (3 + i)} for i in numbers])
        self.assertIn('003.png (1 of 5)', self.text('h2'))
        self.browser.press('ArrowRight')
        self.assertIn('004.png (2 of 5)', self.text('h2'))
        self.make('--overwrite', lines=[line_of(0, 'raw/003.png')])
        self.assertIn('(1 of 1)', self.text('h2'))

    def test_long_drive(self):
        os.mkdir(os.path.join(self.folder, 'long'))
        write_image(os.path.join(self.folder, 'image.png'), RED)
        names = ['long/%05d.png' % i for i in range(LONG)]
        for name in names:
            os.link(os.path.join(self.folder, 'image.png'), os.path.join(self.folder, name))
        self.make('--width=16', lines=[line_of(i, name) for i, name in enumerate(names)])
        self.assertIn('10000 frames: 9997 ok, 2 too_few_segments, 1 failed', self.text())
        self.browser.press('End')
        self.assertIn('09999.png (10000 of 10000)', self.text('h2'))
        self.assert_colours((RED, ), 0.3)
        self.browser.press('z')
        self.assertEqual(100, self.browser.evaluate('shown.length'))
        self.keep_screenshot('page_long')


if __name__ == '__main__':
    if not find_chromium():
        print('[     SKIP ] there is no Chromium')
        sys.exit(77)
    PageTest.program = sys.argv[1]
    PageTest.screenshots = sys.argv[2] if len(sys.argv) > 2 else ''
    unittest.main(argv=sys.argv[:1], verbosity=2)
