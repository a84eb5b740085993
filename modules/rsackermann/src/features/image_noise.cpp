// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../optim/median.hpp"
#include "detectors.hpp"

namespace cv { namespace rsackermann {

double imageNoise(const Mat& gray)
{
    const int enoughPixels = 100000, levels = 8 * UCHAR_MAX + 1;
    const double gain = 6, rounding = 0.29; // of second differences
    std::vector<int> counts(levels);
    const int step = std::max(int(gray.total() / enoughPixels), 1);
    int total = 0;
    for (int y = 1; y + 1 < gray.rows; y += step)
    {
        const uchar* a = gray.ptr(y - 1);
        const uchar* b = gray.ptr(y);
        const uchar* c = gray.ptr(y + 1);
        int left = a[0] - 2 * b[0] + c[0], middle = a[1] - 2 * b[1] + c[1];
        for (int x = 2; x < gray.cols; x++, total++)
        {
            const int right = a[x] - 2 * b[x] + c[x];
            counts[std::abs(left - 2 * middle + right)]++;
            left = middle;
            middle = right;
        }
    }
    int median = 0;
    for (int n = counts[0]; n * 2 < total; n += counts[median])
        median++;
    return std::max(sigmaOfMedian(median) / gain, rounding);
}

}} // namespace cv::rsackermann
