// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "slant_noise.hpp"
#include "residuals/vertical_residual.hpp"

namespace cv { namespace rsackermann {

static const double FACADE_WIDTH = 0.07; // of the columns between verticals that err together: 4 degrees
static const double FREEDOM = 3;         // of Student's t
// How many more verticals say what one would, if roll and pitch are free
static const double DEPENDENCE_BY_TILT = 4;
static const double TILT_OF_DEPENDENCE = CV_PI / 180;
static const double CROWDED = 20;                          // candidates within a facade's width
static const double DETECTOR_ERRORS[] = {0.05, 0.15, 0.4}; // pixels that are tried

Slants::Slants(const RefinementProblem& problem, const Model& model, bool translates)
{
    const PreparedModel prepared(model, problem.heading, problem.roadRatio, translates);
    for (size_t i = 0; i < problem.verticals.size(); i++)
    {
        int wall;
        const UprightSegment& c = problem.verticals[i];
        const double l = norm(c.u - c.v);
        length.push_back(l);
        slant.push_back(verticalResidual(c, prepared, wall, 0) / l);
        gate.push_back(c.gate / l);
        column.push_back((c.u[0] + c.v[0]) / 2);
    }
}

namespace {

// Densities of a slant as a vertical's and as that of something else, by a noise with the error of the detector in
// radians * length.
struct Densities
{
    double variance, q, vertical, other;

    Densities(const Slants& s, size_t i, const SlantNoise& noise, double error)
    {
        variance = noise.lean * noise.lean + error * error / (s.length[i] * s.length[i]);
        q = 1 / (1 + s.slant[i] * s.slant[i] / (FREEDOM * variance));
        const double peak = 2 / (CV_PI * std::sqrt(FREEDOM)); // of Student's t
        vertical = (1 - noise.share) * peak * q * q / std::sqrt(variance);
        other = noise.share / (2 * s.gate[i]);
    }
};

// A step of expectation maximisation in the lean and the share.
void improve(const Slants& s, double error, SlantNoise& noise)
{
    double verticals = 0, squares = 0;
    for (size_t i = 0; i < s.size(); i++)
    {
        const Densities d(s, i, noise, error);
        const double isVertical = d.vertical / (d.vertical + d.other), lean2 = noise.lean * noise.lean,
                     part = lean2 / d.variance;
        verticals += isVertical;
        // The expected square of the lean's part of the slant.
        squares +=
            isVertical * (part * part * (FREEDOM + 1) / FREEDOM * d.q * s.slant[i] * s.slant[i] + lean2 * (1 - part));
    }
    noise.share = std::min(0.95, (s.size() - verticals + 1) / (s.size() + 2));
    const double measured = 0.5 * std::log(std::max(squares / verticals, 1e-12));
    noise.lean = std::exp((verticals * measured + std::log(USUAL_LEAN)) / (verticals + 1));
}

double logLikelihood(const Slants& s, double error, const SlantNoise& noise)
{
    const double unusual = std::log(noise.lean / USUAL_LEAN);
    double sum = -0.5 * unusual * unusual;
    for (size_t i = 0; i < s.size(); i++)
    {
        const Densities d(s, i, noise, error);
        sum += std::log(d.vertical + d.other);
    }
    return sum;
}

} // namespace

SlantNoise fitSlantNoise(const Slants& slants, double focal)
{
    const int steps = 8;
    SlantNoise best = SlantNoise();
    best.logLikelihood = -DBL_MAX;
    for (int k = 0; k < 3; k++)
    {
        SlantNoise noise = {DETECTOR_ERRORS[k], USUAL_LEAN, 0.3, 0};
        for (int i = 0; i < steps; i++)
            improve(slants, noise.pixels / focal, noise);
        noise.logLikelihood = logLikelihood(slants, noise.pixels / focal, noise);
        if (noise.logLikelihood > best.logLikelihood)
            best = noise;
    }
    return best;
}

double dependenceOf(const Slants& s, const SlantNoise& noise, double focal, double& neighbours)
{
    // Robust: the influence of each slant.
    std::vector<double> influence(s.size());
    double squares = 0, products = 0;
    for (size_t i = 0; i < s.size(); i++)
    {
        const Densities d(s, i, noise, noise.pixels / focal);
        influence[i] = s.slant[i] / std::sqrt(d.variance) * d.q;
        squares += influence[i] * influence[i];
    }
    size_t pairs = 0;
    for (size_t i = 0; i < s.size(); i++)
        for (size_t j = i + 1; j < s.size() && s.column[j] - s.column[i] < FACADE_WIDTH; j++, pairs++)
            products += influence[i] * influence[j];
    neighbours = s.size() > 0 ? 2. * pairs / s.size() : 0;
    return squares > 0 ? 1 + 2 * products / squares : 1;
}

double hiddenDependence(const RefinementProblem& problem, const SlantNoise& noise, double neighbours)
{
    const double tilting = std::min(1., problem.rollSigma() / TILT_OF_DEPENDENCE),
                 crowd = std::min(1., neighbours / CROWDED);
    const double leaning = noise.lean / USUAL_LEAN;
    return 1 + DEPENDENCE_BY_TILT * tilting * crowd * leaning * leaning;
}

}} // namespace cv::rsackermann
