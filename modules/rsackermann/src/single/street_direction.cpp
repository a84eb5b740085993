// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../factors/residual_kernels.hpp"
#include "refinement.hpp"

namespace cv { namespace rsackermann {

// Of the loss, in sigmas: the motion, and with it the compensation, is still inexact
static const double COARSENESS = 2 * SLANT_SCALE;
static const double STREET_STEP = 0.01; // radians

// The model with walls along an azimuth.
static Model turnStreet(const Model& model, const MotionHypothesis& hypothesis, double azimuth)
{
    Model aligned = model;
    aligned[P_STREET] = azimuth;
    if (hypothesis.translates())
    {
        // Along or against the azimuth: the walls stay on the side on which they are.
        const double size = std::hypot(model[P_B], model[P_D]);
        const double sign = model[P_B] * std::cos(azimuth) + model[P_D] * std::sin(azimuth) < 0 ? -1 : 1;
        aligned[P_B] = sign * size * std::cos(azimuth);
        aligned[P_D] = sign * size * std::sin(azimuth);
    }
    return aligned;
}

bool startFromStreetDirection(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Model& model)
{
    if (problem.others.empty())
        return false;
    const int padded = problem.otherArrays.paddedSize();
    AutoBuffer<float> points(4 * size_t(padded));
    compensateSegments(problem.otherArrays, PreparedModel(model, problem.heading, problem.roadRatio), points.data());

    const double scale = problem.focal / (COARSENESS * problem.directionSigma);
    double bestCost = DBL_MAX, best = 0;
    const double range = problem.streetDeviation > 0 ? std::min(2 * problem.streetDeviation, CV_PI / 2) : CV_PI / 2;
    for (double offset = -range; offset <= range; offset += STREET_STEP)
    {
        const double azimuth = problem.heading.angle + offset;
        const double cost = streetCost(points.data(), padded, std::sin(azimuth), std::cos(azimuth), scale);
        if (cost < bestCost)
        {
            bestCost = cost;
            best = azimuth;
        }
    }
    const double before = hypothesis.translates() ? std::atan2(model[P_D], model[P_B]) : model[P_STREET];
    model = turnStreet(model, hypothesis, best);
    return std::abs(std::sin(best - before)) > 1e-9; // more than rounding
}

}} // namespace cv::rsackermann
