"""A headless Chromium, told what to do over pipes by the protocol of its developer tools."""

import base64
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import zlib

FAULTS = ('Runtime.exceptionThrown', 'Log.entryAdded', 'Runtime.consoleAPICalled')
KEYS = {'ArrowLeft': 37, 'ArrowRight': 39, 'Home': 36, 'End': 35, 'Tab': 9}


def find_chromium():
    """The program, or None."""
    return shutil.which('chromium') or shutil.which('chromium-browser')


class Browser:
    def __init__(self, width=1400, height=1000):
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        commands, self._to = os.pipe()
        self._from, answers = os.pipe()
        # The browser reads from 3 and writes to 4.
        self._process = subprocess.Popen(
            ['bash', '-c', 'exec "$@" 3<&%d 4>&%d' % (commands, answers), 'bash', find_chromium(), '--headless',
             '--no-sandbox', '--disable-gpu', '--user-data-dir=' + self._folder.name, '--remote-debugging-pipe'],
            pass_fds=(commands, answers), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self._read, self._number, self._session, self._events = b'', 0, None, []
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self._session = self.call('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log'):
            self.call(domain + '.enable')
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self._to)
        os.close(self._from)
        self._process.terminate()
        self._process.wait()
        self._folder.cleanup()

    def _receive(self):
        while b'\0' not in self._read:
            part = os.read(self._from, 1 << 20)
            if not part:
                raise RuntimeError('Chromium has ended')
            self._read += part
        message, _, self._read = self._read.partition(b'\0')
        return json.loads(message)

    def call(self, method, **params):
        self._number += 1
        message = {'id': self._number, 'method': method, 'params': params}
        if self._session:
            message['sessionId'] = self._session
        os.write(self._to, json.dumps(message).encode() + b'\0')
        while True:
            answer = self._receive()
            if answer.get('id') != self._number:
                self._events.append(answer)
            elif 'error' in answer:
                raise RuntimeError('%s: %s' % (method, answer['error']))
            else:
                return answer['result']

    def open(self, path):
        """Opens a file and waits until all of it is loaded."""
        self._events = []
        self.call('Page.navigate', url=pathlib.Path(path).absolute().as_uri())
        while not any(event.get('method') == 'Page.loadEventFired' for event in self._events):
            self._events.append(self._receive())

    def evaluate(self, expression):
        result = self.call('Runtime.evaluate', expression=expression, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in result:
            raise RuntimeError('%s: %s' % (expression, result['exceptionDetails']))
        return result['result'].get('value')

    def press(self, key):
        for kind in ('keyDown', 'keyUp'):
            text = {'text': key} if len(key) == 1 and kind == 'keyDown' else {}
            self.call('Input.dispatchKeyEvent', type=kind, key=key,
                      windowsVirtualKeyCode=KEYS.get(key, ord(key[0].upper())), **text)

    def mouse(self, kind, x, y):
        self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, button='left', buttons=1, clickCount=1)

    def click(self, x, y):
        self.mouse('mousePressed', x, y)
        self.mouse('mouseReleased', x, y)

    def set_scheme(self, scheme):
        self.call('Emulation.setEmulatedMedia', features=[{'name': 'prefers-color-scheme', 'value': scheme}])

    def picture(self, **clip):
        """The PNG of what is seen."""
        options = {'clip': dict(clip, scale=1)} if clip else {}
        return base64.b64decode(self.call('Page.captureScreenshot', format='png', **options)['data'])

    def colour(self, x, y):
        """Red, green and blue of a pixel: of the only one of a PNG no filter changes the values."""
        png, place, data = self.picture(x=x, y=y, width=1, height=1), 8, b''
        while place < len(png):
            size = int.from_bytes(png[place:place + 4], 'big')
            if png[place + 4:place + 8] == b'IDAT':
                data += png[place + 8:place + 8 + size]
            place += size + 12
        return tuple(zlib.decompress(data)[1:4])

    def faults(self):
        """What the page has written to the console, and errors."""
        return [event for event in self._events if event.get('method') in FAULTS]
