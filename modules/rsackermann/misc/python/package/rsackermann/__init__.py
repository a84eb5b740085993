# This file is part of OpenCV project.
# It is subject to the license terms in the LICENSE file found in the top-level directory
# of this distribution and at http://opencv.org/license.html.
'''Lets the values of the module be pickled and copied, which types of an extension can't do by themselves.'''

__all__ = []

import copyreg
import inspect

import cv2 as cv

_VALUE_TYPES = {
    'RollingShutterCamera': cv.rsackermann.RollingShutterCamera,
    'AckermannMotion': cv.rsackermann.AckermannMotion,
    'MotionPrior': cv.rsackermann.MotionPrior,
    'AckermannEstimator.Params': cv.rsackermann.AckermannEstimator.Params,
    'WarpMapGenerator.Params': cv.rsackermann.WarpMapGenerator.Params,
}
# Without read() and write().
_RECORD_TYPES = {
    'MetricMotion': cv.rsackermann.MetricMotion,
    'DepthMap': cv.rsackermann.DepthMap,
}
if hasattr(cv.rsackermann, 'RollingShutterCorrector'):  # not in a build with RSACKERMANN_CORE_ONLY
    _VALUE_TYPES['MountCalibrator.Params'] = cv.rsackermann.MountCalibrator.Params
    _VALUE_TYPES['RollingShutterCorrector.Params'] = cv.rsackermann.RollingShutterCorrector.Params
    _RECORD_TYPES['MountCalibration'] = cv.rsackermann.MountCalibration


def _restore(name, text):
    value = _VALUE_TYPES[name]()
    storage = cv.FileStorage(text, cv.FileStorage_READ + cv.FileStorage_MEMORY)
    value.read(storage.root())
    return value


def _register(name, value_type):
    def reduce(value):
        storage = cv.FileStorage('.yml', cv.FileStorage_WRITE + cv.FileStorage_MEMORY)
        value.write(storage)
        return _restore, (name, storage.releaseAndGetString())

    copyreg.pickle(value_type, reduce)


def _restore_record(name, fields):
    value = _RECORD_TYPES[name]()
    for field, content in fields.items():
        setattr(value, field, content)
    return value


def _register_record(name, value_type):
    fields = [field for field, _ in inspect.getmembers(value_type, inspect.isgetsetdescriptor)]

    def reduce(value):
        return _restore_record, (name, {field: getattr(value, field) for field in fields})

    copyreg.pickle(value_type, reduce)


for _name, _value_type in _VALUE_TYPES.items():
    _register(_name, _value_type)
for _name, _value_type in _RECORD_TYPES.items():
    _register_record(_name, _value_type)
