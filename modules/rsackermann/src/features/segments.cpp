// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "segments.hpp"

namespace cv { namespace rsackermann {

Mat segmentRows(InputArray segments, const char* name)
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

void returnSegments(const Mat& rows, OutputArray segments)
{
    const bool fourChannels = segments.fixedType() && segments.channels() == 4;
    checkOutput(segments, "segments", Size(fourChannels ? 1 : 4, rows.rows), fourChannels ? segments.type() : CV_32F);
    segments.create(rows.rows, fourChannels ? 1 : 4, fourChannels ? segments.type() : CV_32F);
    if (rows.rows > 0)
        (fourChannels ? rows.reshape(4) : rows).convertTo(segments, fourChannels ? segments.depth() : CV_32F);
}

}} // namespace cv::rsackermann
