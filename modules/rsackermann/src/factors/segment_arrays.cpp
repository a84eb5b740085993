// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "segment_arrays.hpp"

namespace cv { namespace rsackermann {

void SegmentArrays::assign(const std::vector<UprightSegment>& segments)
{
    count = (int)segments.size();
    padded = (int)alignSize(segments.size(), MAX_LANES);
    numbers.assign(size_t(FIELDS) * padded, 0.);
    for (int i = 0; i < count; i++)
    {
        const UprightSegment& c = segments[i];
        const double values[SCALE] = {c.u[0], c.u[1], c.v[0], c.v[1], c.timeU, c.timeV};
        for (int field = 0; field < SCALE; field++)
            numbers[size_t(field) * padded + i] = values[field];
    }
    rounded.assign(numbers.begin(), numbers.end());
}

// A detector fits a chord to an image that the lens has bent, to a parabola: its distance is the sagitta times
// sqrt(4 / 45), in the root mean square (doc/theory.md, "Estimation").
static double detectionSigma(const UprightSegment& segment, double sigma)
{
    return std::hypot(sigma, std::sqrt(4. / 45) * segment.sagitta);
}

void SegmentArrays::weigh(const std::vector<UprightSegment>& segments, double focal, double sigma, double lean)
{
    for (int i = 0; i < count; i++)
    {
        const size_t place = size_t(SCALE) * padded + i;
        numbers[place] =
            focal / std::hypot(detectionSigma(segments[i], sigma), focal * lean * norm(segments[i].u - segments[i].v));
        rounded[place] = float(numbers[place]);
    }
}

}} // namespace cv::rsackermann
