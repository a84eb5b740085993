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

namespace {

// The segments that aren't verticals, compensated by a motion, and how far they are from pointing along a street or
// across it.
class StreetSearch
{
public:
    StreetSearch(const RefinementProblem& problem_, const Model& model)
        : problem(problem_), padded(problem_.otherArrays.paddedSize()), points(4 * size_t(padded)),
          range(problem_.streetDeviation > 0 ? std::min(2 * problem_.streetDeviation, CV_PI / 2) : CV_PI / 2)
    {
        compensateSegments(problem.otherArrays, PreparedModel(model, problem.heading, problem.roadRatio),
                           points.data());
    }

    double first() const { return problem.heading.angle - range; }

    // Calls function(azimuth, cost) for azimuths that are possible. @param coarseness of the loss, in sigmas
    // @param through one that is among them, or whole steps away.
    template <class Function>
    void forEachAzimuth(double coarseness, double through, const Function& function) const
    {
        const double scale = problem.focal / (coarseness * problem.directionSigma),
                     shift = std::remainder(through - first(), STREET_STEP);
        for (double offset = 0; offset <= 2 * range; offset += STREET_STEP)
        {
            const double azimuth = first() + offset + shift;
            function(azimuth, streetCost(points.data(), padded, std::sin(azimuth), std::cos(azimuth), scale));
        }
    }

private:
    const RefinementProblem& problem;
    const int padded;
    AutoBuffer<float> points;
    const double range;
};

} // namespace

bool startFromStreetDirection(const RefinementProblem& problem, const MotionHypothesis& hypothesis, Model& model)
{
    if (problem.others.empty())
        return false;
    double bestCost = DBL_MAX, best = 0;
    const StreetSearch search(problem, model);
    search.forEachAzimuth(COARSENESS, search.first(), [&](double azimuth, double cost) {
        if (cost < bestCost)
        {
            bestCost = cost;
            best = azimuth;
        }
    });
    const double before = hypothesis.translates() ? std::atan2(model[P_D], model[P_B]) : model[P_STREET];
    model = turnStreet(model, hypothesis, best);
    return std::abs(std::sin(best - before)) > 1e-9; // more than rounding
}

double varianceOfOtherStreets(const RefinementProblem& problem, const Fit& fit)
{
    const int count = int(problem.others.size());
    if (count == 0 || !fit.hypothesis.translates())
        return 0;
    Model ofVerticals = fit.model;
    Matx<double, PARAMETERS, PARAMETERS> covariance;
    const int iterations = 8;
    refine(problem, fit.hypothesis, VERTICALS_ONLY, iterations, ofVerticals, &covariance);
    const Vec2d wall(ofVerticals[P_B], ofVerticals[P_D]), byWall = Vec2d(-wall[1], wall[0]) / wall.dot(wall);
    const double variance = byWall.dot(covariance.get_minor<2, 2>(P_B, P_B) * byWall);
    if (!(variance > 0))
        return 0;

    std::vector<double> azimuths, agreeing;
    const double own = std::atan2(fit.model[P_D], fit.model[P_B]);
    StreetSearch(problem, fit.model).forEachAzimuth(problem.lossScale, own, [&](double azimuth, double cost) {
        azimuths.push_back(azimuth);
        agreeing.push_back(std::max(count - cost, 0.)); // the cost is rounded
    });
    const double logChance = std::log(std::max(cv::mean(agreeing)[0] / count, DBL_MIN));
    std::vector<double> logWeights;
    for (size_t i = 0; i < azimuths.size(); i++)
    {
        const double k = agreeing[i], offset = std::sin(azimuths[i] - std::atan2(wall[1], wall[0]));
        logWeights.push_back(std::lgamma(k + 1) + std::lgamma(count - k + 1) - k * logChance -
                             offset * offset / (2 * variance));
    }
    const double largest = *std::max_element(logWeights.begin(), logWeights.end());
    double sum = 0, squares = 0;
    for (size_t i = 0; i < azimuths.size(); i++)
    {
        const double weight = std::exp(logWeights[i] - largest), offset = std::sin(azimuths[i] - own);
        sum += weight;
        squares += weight * offset * offset;
    }
    return squares / sum;
}

}} // namespace cv::rsackermann
