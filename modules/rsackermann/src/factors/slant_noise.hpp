// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_SLANT_NOISE_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_SLANT_NOISE_HPP

#include "opencv2/core.hpp"

namespace cv { namespace rsackermann {

//! By how much the candidates lean that a model should have made upright.
struct Slants
{
    std::vector<double> slant, length; // tangents, and lengths of the segments for a focal length of 1

    size_t size() const { return slant.size(); }
};

/** The distribution of the slants of upright candidates (doc/theory.md, "Evidence").

Student's t with 3 degrees of freedom, twice: for verticals, which a detector places with an error in pixels and which
lean in the scene, and wider for lines that aren't vertical.
*/
struct SlantNoise
{
    double pixels;    // scale of the detector's error
    double lean;      // scale of the lean in the scene, radians
    double share;     // of the segments that aren't verticals
    double otherLean; // scale of their lean
    double logLikelihood;

    //! The slant, in scales of that of a vertical, beyond which it is the loss of another line that counts.
    double lossScale(const Slants& slants, double focal) const;
};

/** The noise with the highest likelihood; at least one slant is needed.
@param start noise of other slants of the same image, which has the detector's error, or null. */
SlantNoise fitSlantNoise(const Slants& slants, double focal, const SlantNoise* start = 0);

//! The highest logarithm of the likelihood if no slant is that of a vertical.
double logLikelihoodWithoutVerticals(const Slants& slants);

/** By how much slants say less than their number (doc/theory.md, "Evidence"): an uncertain roll hides what they share.
@param rollSigma of gravity. */
double dependenceOf(double rollSigma);

//! Density of a slant, Student's t with 3 degrees of freedom. @tparam T double or a vector of numbers.
template <class T>
struct SlantDensity
{
    static double peak() { return 2 / (CV_PI * std::sqrt(3.)); }

    T slant2, fading, value;

    //! @param scale of the distribution @param scale2 its square @param slant2_ square of the slant
    SlantDensity(const T& scale, const T& scale2, const T& slant2_)
        : slant2(slant2_), fading(T(3) * scale2 / (T(3) * scale2 + slant2_)), value(T(peak()) * fading * fading / scale)
    {
    }

    //! Square of the slant, weighed for the estimate of the scale.
    T weighedSquare() const { return T(4. / 3) * fading * slant2; }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_SLANT_NOISE_HPP
