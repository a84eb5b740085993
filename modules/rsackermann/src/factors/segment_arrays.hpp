// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_ARRAYS_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_ARRAYS_HPP

#include "../features/upright_segment.hpp"

namespace cv { namespace rsackermann {

/** Candidates as one array for each of their numbers, for vectors.

The arrays are filled up to a multiple of the largest vector, with segments of the weight 0.
*/
class SegmentArrays
{
public:
    enum Field { U_X, U_Y, V_X, V_Y, TIME_U, TIME_V, SCALE, FIELDS };
    enum { MAX_LANES = 16 };

    void assign(const std::vector<UprightSegment>& segments);

    /** Sets SCALE, by which a residual is to be multiplied: the focal length over the standard deviation.
    @param sigma pixels by which a detector errs.
    @param lean radians by which the line in the scene leans.
    */
    void weigh(const std::vector<UprightSegment>& segments, double focal, double sigma, double lean);

    int size() const { return count; }
    int paddedSize() const { return padded; }
    //! In the precision of the second argument, which is only there to choose it.
    const double* at(Field field, double) const { return numbers.data() + size_t(field) * padded; }
    const float* at(Field field, float) const { return rounded.data() + size_t(field) * padded; }

private:
    int count = 0, padded = 0;
    std::vector<double> numbers;
    std::vector<float> rounded;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_SEGMENT_ARRAYS_HPP
