// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_SLANT_NOISE_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_SLANT_NOISE_HPP

#include "refinement.hpp"

namespace cv { namespace rsackermann {

//! By how much the candidates lean that a model should have made upright.
struct Slants
{
    std::vector<double> slant, length, gate; // tangents, and lengths of the segments for a focal length of 1
    std::vector<double> column;              // in ascending order

    Slants(const RefinementProblem& problem, const Model& model, bool translates);
    size_t size() const { return slant.size(); }
};

/** The distribution of the slants of upright candidates (doc/theory.md, "Evidence").

Student's t with 3 degrees of freedom for verticals, which a detector places with an error in pixels and which lean in
the scene, and a uniform distribution within the gates for segments that aren't images of verticals.
*/
struct SlantNoise
{
    double pixels; // scale of the detector's error
    double lean;   // scale of the lean in the scene, radians
    double share;  // of the segments that aren't verticals
    double logLikelihood;
};

SlantNoise fitSlantNoise(const Slants& slants, double focal);

/** By how much the slants say less than their number (doc/theory.md, "Evidence"): verticals of one facade err together.
@param neighbours receives the mean number of other candidates within the width of a facade.
*/
double dependenceOf(const Slants& slants, const SlantNoise& noise, double focal, double& neighbours);

//! By how much they say less although the residuals don't show it: roll, pitch and motion take up a lean that a crowd
//! has in common.
double hiddenDependence(const RefinementProblem& problem, const SlantNoise& noise, double neighbours);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_SLANT_NOISE_HPP
