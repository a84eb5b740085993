// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "significance.hpp"

namespace cv { namespace rsackermann {

static double logBinomial(int n, int k)
{
    double sum = 0;
    for (int i = 0; i < k; i++)
        sum += std::log((n - i) / double(k - i));
    return sum;
}

double logFalseAlarms(int candidates, int inliers, int sampleSize, double chance)
{
    if (inliers <= sampleSize)
        return DBL_MAX;
    return std::log(double(candidates - sampleSize)) + logBinomial(candidates, inliers) +
           logBinomial(inliers, sampleSize) + (inliers - sampleSize) * std::log(chance);
}

}} // namespace cv::rsackermann
