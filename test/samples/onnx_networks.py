#!/usr/bin/env python3
"""Writes small ONNX networks whose output is known, and some that are wrong, for tests of depth networks.

An ONNX file is a message of Protocol Buffers: fields, each with its number, the kind of its value, and the value. Only
the fields that these networks need are written, so that neither onnx nor protobuf is needed.

usage: onnx_networks.py FOLDER WIDTH HEIGHT [DEPTH]
       for input of that size; DEPTH has WIDTH x HEIGHT numbers (float32), the output of the network `given`
"""

import os
import struct
import sys

FLOAT, INTEGERS = 1, 7  # the types of elements and of attributes


def varint(number):
    result = bytearray()
    while number > 0x7F:
        result.append(number & 0x7F | 0x80)
        number >>= 7
    result.append(number)
    return bytes(result)


def integer(field, value):
    return varint(field << 3) + varint(value)


def block(field, value):
    """A text, or a message in a message."""
    value = value.encode() if isinstance(value, str) else value
    return varint(field << 3 | 2) + varint(len(value)) + value


def tensor(name, shape, values):
    return (b''.join(integer(1, size) for size in shape) + integer(2, FLOAT) + block(8, name) +
            block(9, struct.pack('<%df' % len(values), *values)))


def node(operator, inputs, output, attributes=b''):
    return (b''.join(block(1, name) for name in inputs) + block(2, output) + block(3, 'node_' + output) +
            block(4, operator) + attributes)


def weighted_sum(image, output):
    """Of the channels at each pixel, by the tensors weights and bias: a convolution of one pixel."""
    size = block(1, 'kernel_shape') + integer(8, 1) * 2 + integer(20, INTEGERS)
    return node('Conv', [image, 'weights', 'bias'], output, block(5, size))


def value(name, shape):
    sizes = b''.join(block(1, integer(1, size)) for size in shape)
    return block(1, name) + block(2, block(1, integer(1, FLOAT) + block(2, sizes)))


def model(nodes, tensors, inputs, outputs):
    """Of version 7 of the format, with the operators of version 11."""
    graph = (b''.join(block(1, node) for node in nodes) + block(2, 'depth') +
             b''.join(block(5, tensor) for tensor in tensors) + b''.join(block(11, value) for value in inputs) +
             b''.join(block(12, value) for value in outputs))
    return integer(1, 7) + block(7, graph) + block(8, block(1, '') + integer(2, 11))


def sum_of_channels(weights, bias, size, channels=1):
    width, height = size
    return model([weighted_sum('image', 'depth')],
                 [tensor('weights', (channels, 3, 1, 1), weights * channels),
                  tensor('bias', (channels,), [bias] * channels)],
                 [value('image', (1, 3, height, width))], [value('depth', (1, channels, height, width))])


def given(depth, size):
    """The same output for each image."""
    width, height = size
    shape = (1, 1, height, width)
    return model([weighted_sum('image', 'nothing'), node('Add', ['nothing', 'given'], 'depth')],
                 [tensor('weights', (1, 3, 1, 1), [0, 0, 0]), tensor('bias', (1,), [0]),
                  tensor('given', shape, depth)],
                 [value('image', (1, 3, height, width))], [value('depth', shape)])


def two_inputs(size):
    shape = (1, 3, size[1], size[0])
    return model([node('Add', ['image', 'other'], 'depth')], [], [value('image', shape), value('other', shape)],
                 [value('depth', shape)])


def two_outputs(size):
    shape = (1, 1, size[1], size[0])
    return model([weighted_sum('image', 'depth'), weighted_sum('image', 'confidence')],
                 [tensor('weights', (1, 3, 1, 1), [1, 1, 1]), tensor('bias', (1,), [0])],
                 [value('image', (1, 3, size[1], size[0]))], [value('depth', shape), value('confidence', shape)])


def one_number(size):
    return model([node('GlobalAveragePool', ['image'], 'mean'), weighted_sum('mean', 'depth')],
                 [tensor('weights', (1, 3, 1, 1), [1, 1, 1]), tensor('bias', (1,), [0])],
                 [value('image', (1, 3, size[1], size[0]))], [value('depth', (1, 1, 1, 1))])


def unknown_operator(size):
    shape = (1, 3, size[1], size[0])
    return model([node('NoSuchOperator', ['image'], 'depth')], [], [value('image', shape)], [value('depth', shape)])


#: Of red, green and blue.
WEIGHTS, BIAS = [0.25, 0.5, 0.125], 0.75


def main(folder, width, height, depth=None):
    size = int(width), int(height)
    networks = {
        'sum': sum_of_channels(WEIGHTS, BIAS, size),
        'constant': sum_of_channels([0, 0, 0], BIAS, size),
        'two_channels': sum_of_channels(WEIGHTS, BIAS, size, channels=2),
        'two_inputs': two_inputs(size),
        'two_outputs': two_outputs(size),
        'one_number': one_number(size),
        'unknown_operator': unknown_operator(size),
    }
    networks['cut'] = networks['sum'][:len(networks['sum']) // 2]
    if depth:
        with open(depth, 'rb') as file:
            numbers = struct.unpack('<%df' % (size[0] * size[1]), file.read())
        networks['given'] = given(numbers, size)
    for name, content in networks.items():
        with open(os.path.join(folder, name + '.onnx'), 'wb') as file:
            file.write(content)


if __name__ == '__main__':
    main(*sys.argv[1:])
