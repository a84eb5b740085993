// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_CHECKS_HPP
#define OPENCV_RSACKERMANN_SRC_CHECKS_HPP

#include "opencv2/rsackermann/motion.hpp"

//! Throws cv::Exception with a message, formatted as by cv::format, if an argument is bad. A macro: the exception has
//! the function and the line.
#define REJECT_IF(isBad, ...)                                                                                          \
    do                                                                                                                 \
    {                                                                                                                  \
        if (isBad)                                                                                                     \
            CV_Error(cv::Error::StsBadArg, cv::format(__VA_ARGS__));                                                   \
    }                                                                                                                  \
    while (false)

namespace cv { namespace rsackermann {

//! Of what a caller gives: its powers, and quotients of two of them, are finite.
const double LARGEST_VALUE = 1e30;

//! Throws unless the value is finite, and not absurd.
inline void checkFinite(double value, const char* name)
{
    REJECT_IF(!(std::abs(value) <= LARGEST_VALUE), "%s is %g; a finite number up to %g is expected", name, value,
              LARGEST_VALUE);
}

//! Throws unless the value is finite and greater than 0.
inline void checkPositive(double value, const char* name)
{
    REJECT_IF(!(value >= 1 / LARGEST_VALUE && value <= LARGEST_VALUE),
              "%s is %g; a positive number up to %g is expected", name, value, LARGEST_VALUE);
}

//! Throws unless the value is finite and 0 or greater; 0 has the given meaning.
inline void checkNotNegative(double value, const char* name, const char* meaningOfZero)
{
    REJECT_IF(value != 0 && !(value >= 1 / LARGEST_VALUE && value <= LARGEST_VALUE),
              "%s is %g; a positive number up to %g, or 0 for %s, is expected", name, value, LARGEST_VALUE,
              meaningOfZero);
}

//! Throws unless the value is finite and within the limits, which belong to the range.
inline void checkRange(double value, double low, double high, const char* name)
{
    checkFinite(value, name);
    REJECT_IF(value < low || value > high, "%s is %g; a number from %g to %g is expected", name, value, low, high);
}

//! Throws unless the value is at most one turn to either side: degrees seldom are.
inline void checkAngle(double radians, const char* name)
{
    checkFinite(radians, name);
    REJECT_IF(std::abs(radians) > 2 * CV_PI, "%s is %g; radians from -2 pi to 2 pi are expected", name, radians);
}

//! Throws unless images, points and maps can follow the motion.
void checkMotion(const AckermannMotion& motion);

//! Whether it is one matrix or a vector of elements, or nothing; lists of matrices are none.
inline bool isOneMatrix(const _InputArray& input)
{
    const int kind = input.kind();
    return kind == _InputArray::NONE || kind == _InputArray::MAT || kind == _InputArray::UMAT ||
           kind == _InputArray::MATX || kind == _InputArray::EXPR || kind == _InputArray::STD_VECTOR ||
           kind == _InputArray::STD_BOOL_VECTOR;
}

//! The matrix of an argument; throws if it isn't one.
inline Mat matrixOf(InputArray input, const char* name)
{
    REJECT_IF(!isOneMatrix(input), "%s is a list of matrices or lists; one matrix is expected", name);
    return input.getMat();
}

//! Throws unless it is one image and, if a size is expected, has it.
inline void checkImageSize(InputArray image, const char* name, const Size& expected)
{
    REJECT_IF(!isOneMatrix(image) || image.dims() > 2 || image.empty(),
              "%s is empty or not one matrix of two dimensions; an image is expected", name);
    REJECT_IF(expected != Size() && image.size() != expected, "%s is %d x %d; the camera's size %d x %d is expected",
              name, image.cols(), image.rows(), expected.width, expected.height);
}

//! Throws unless segments and points can be looked for in an image.
inline void checkImage(InputArray image, const char* name, const Size& expected = Size())
{
    checkImageSize(image, name, expected);
    const int depth = image.depth(), channels = image.channels();
    REJECT_IF((depth != CV_8U && depth != CV_16U) || (channels != 1 && channels != 3 && channels != 4),
              "%s is of type %s; CV_8U or CV_16U with 1, 3 or 4 channels is expected", name,
              typeToString(image.type()).c_str());
}

//! Throws unless cv::remap takes an image with that interpolation.
inline void checkRemapped(InputArray image, const char* name, const Size& expected, int interpolation)
{
    checkImageSize(image, name, expected);
    const int depth = image.depth();
    const bool isNearest = interpolation == INTER_NEAREST, isCopied = isNearest && (depth == CV_8S || depth == CV_32S);
    REJECT_IF(depth != CV_8U && depth != CV_16U && depth != CV_16S && depth != CV_32F && depth != CV_64F && !isCopied,
              "%s is of type %s; CV_8U, CV_16U, CV_16S, CV_32F%s is expected", name, typeToString(image.type()).c_str(),
              isNearest ? ", CV_64F, CV_8S or CV_32S" : " or CV_64F");
}

/** Throws unless an output can become a matrix of that size and type: it is one whose size and type aren't fixed to
others, or a vector of such elements. Before any work is done, so that nothing has changed. */
inline void checkOutput(const _OutputArray& output, const char* name, const Size& size, int type)
{
    const bool isVector = output.kind() == _InputArray::STD_VECTOR, isMatrix = output.isMat() || output.isUMat(),
               isFixed = output.isMatx(), isKnown = isVector || isMatrix || isFixed;
    if (isKnown && (!output.fixedType() || output.type() == type) &&
        (!(output.fixedSize() || isFixed) || output.size() == size) &&
        (!isVector || size.width <= 1 || size.height <= 1))
        return;
    const String given = !output.needed() ? "missing"
                         : !isKnown       ? "neither a matrix nor a vector of elements"
                                    : String(isVector ? "a vector of " : "a matrix of ") + typeToString(output.type());
    CV_Error(Error::StsBadArg, format("%s is %s; one that can become %d x %d of type %s is expected", name,
                                      given.c_str(), size.width, size.height, typeToString(type).c_str()));
}

//! Whether matrices share elements: regions of one image needn't, though their rows take turns in memory.
inline bool overlap(const Mat& a, const Mat& b)
{
    if (a.empty() || b.empty())
        return false;
    const Mat &first = a.data <= b.data ? a : b, &second = a.data <= b.data ? b : a;
    if (first.dims > 2 || second.dims > 2)
        return second.data < first.dataend;
    const size_t away = size_t(second.data - first.data), step = first.step[0], width = first.cols * first.elemSize();
    if (away >= (first.rows - 1) * step + width)
        return false;
    const size_t down = away / step, aside = away % step;
    return second.step[0] != step || (aside < width && down < size_t(first.rows)) ||
           (aside + second.cols * second.elemSize() > step && down + 1 < size_t(first.rows));
}

//! Whether two arguments are one matrix or share elements; of a UMat, whether they begin with the same one.
inline bool areOneMatrix(const _InputArray& a, const _InputArray& b)
{
    if (a.getObj() != NULL && a.getObj() == b.getObj())
        return true;
    if (a.isMat() && b.isMat())
        return overlap(a.getMat(), b.getMat());
    return a.isUMat() && b.isUMat() && a.getUMat().u != NULL && a.getUMat().u == b.getUMat().u &&
           a.getUMat().offset == b.getUMat().offset;
}

//! Throws if an output would replace another argument that is still needed.
inline void checkApart(const _InputArray& output, const char* name, const _InputArray& other, const char* otherName)
{
    REJECT_IF(areOneMatrix(output, other), "%s is the same matrix as %s, or overlaps it; another one is expected", name,
              otherName);
}

//! A caller's segments, N x 4 or N x 1 with four channels, as N x 4 CV_64F; throws for everything else.
inline Mat segmentRows(InputArray segments, const char* name = "segments")
{
    const Mat in = matrixOf(segments, name);
    if (in.empty())
        return Mat(0, 4, CV_64F);
    const bool fourColumns = in.channels() == 1 && in.cols == 4,
               fourChannels = in.channels() == 4 && (in.cols == 1 || in.rows == 1);
    REJECT_IF(
        (in.depth() != CV_32F && in.depth() != CV_64F) || in.dims > 2 || (!fourColumns && !fourChannels),
        "%s is a %d x %d matrix of type %s; N x 4 with one channel or N x 1 with four channels, CV_32F or CV_64F, is "
        "expected",
        name, in.rows, in.cols, typeToString(in.type()).c_str());
    Mat rows;
    in.convertTo(rows, CV_64F);
    return rows.isContinuous() ? rows.reshape(1, (int)(rows.total() * rows.channels() / 4)) : rows;
}

//! Returns N x 4 segments to a caller: as N x 4 CV_32F, or in the four-channel type of the caller's array, such as
//! vector<Vec4f>.
inline void returnSegments(const Mat& rows, OutputArray segments)
{
    const bool fourChannels = segments.fixedType() && segments.channels() == 4;
    checkOutput(segments, "segments", Size(fourChannels ? 1 : 4, rows.rows), fourChannels ? segments.type() : CV_32F);
    segments.create(rows.rows, fourChannels ? 1 : 4, fourChannels ? segments.type() : CV_32F);
    if (rows.rows > 0)
        (fourChannels ? rows.reshape(4) : rows).convertTo(segments, fourChannels ? segments.depth() : CV_32F);
}

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_CHECKS_HPP
