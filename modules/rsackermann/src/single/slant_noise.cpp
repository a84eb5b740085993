// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "slant_noise.hpp"
#include "../factors/robust_losses.hpp"
#include "../factors/vertical_residual.hpp"

namespace cv { namespace rsackermann {

static const double FREEDOM = 3;                                  // of Student's t
static const double HIDING_ROLL = CV_PI / 180;                    // hides what verticals share
static const double OTHER_LEAN = 3 * CV_PI / 180;                 // usual scale for lines that aren't vertical
static const double DISTINCT = 2;                                 // least ratio of both scales
static const double DETECTOR_ERRORS[] = {0.005, 0.05, 0.15, 0.4}; // pixels that are tried

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
    }
}

namespace {

// Densities of a slant as a vertical's and as that of something else, by a noise with the error of the detector in
// radians * length.
// Student's t, with 3 degrees of freedom as its norm has it.
struct StudentT
{
    double q, density;

    StudentT(double slant, double variance)
    {
        const double peak = 2 / (CV_PI * std::sqrt(FREEDOM));
        q = 1 / (1 + slant * slant / (FREEDOM * variance));
        density = peak * q * q / std::sqrt(variance);
    }

    //! Square of a slant, weighed for the estimate of the scale.
    double weighedSquare(double slant) const { return (FREEDOM + 1) / FREEDOM * q * slant * slant; }
};

// The densities of one slant, each with its share.
struct Densities
{
    double variance; // of a vertical
    StudentT vertical, other;
    double ofVertical, ofOther;

    Densities(const Slants& s, size_t i, const SlantNoise& noise, double error)
        : variance(noise.lean * noise.lean + error * error / (s.length[i] * s.length[i])),
          vertical(s.slant[i], variance), other(s.slant[i], noise.otherLean * noise.otherLean),
          ofVertical((1 - noise.share) * vertical.density), ofOther(noise.share * other.density)
    {
    }
};

// Logarithmic mean of a measured scale, which counts as often as it was seen, and of the usual one, which counts once.
double scaleOf(double squares, double count, double usual)
{
    const double measured = 0.5 * std::log(std::max(squares / std::max(count, DBL_MIN), 1e-12));
    return std::exp((count * measured + std::log(usual)) / (count + 1));
}

// One step of expectation and maximisation.
void improve(const Slants& s, double error, SlantNoise& noise)
{
    double verticals = 0, squares = 0, otherSquares = 0;
    for (size_t i = 0; i < s.size(); i++)
    {
        const Densities d(s, i, noise, error);
        const double isVertical = d.ofVertical / (d.ofVertical + d.ofOther), lean2 = noise.lean * noise.lean,
                     part = lean2 / d.variance;
        verticals += isVertical;
        // The expected square of the lean's part of the slant.
        squares += isVertical * (part * part * d.vertical.weighedSquare(s.slant[i]) + lean2 * (1 - part));
        otherSquares += (1 - isVertical) * d.other.weighedSquare(s.slant[i]);
    }
    noise.share = std::min(0.95, (s.size() - verticals + 1) / (s.size() + 2));
    noise.lean = scaleOf(squares, verticals, PRIOR_LEAN);
    noise.otherLean = std::max(DISTINCT * noise.lean, scaleOf(otherSquares, s.size() - verticals, OTHER_LEAN));
}

double logLikelihood(const Slants& s, double error, const SlantNoise& noise)
{
    const double unusual = std::log(noise.lean / PRIOR_LEAN), otherUnusual = std::log(noise.otherLean / OTHER_LEAN);
    double sum = -0.5 * (unusual * unusual + otherUnusual * otherUnusual);
    for (size_t i = 0; i < s.size(); i++)
    {
        const Densities d(s, i, noise, error);
        sum += std::log(d.ofVertical + d.ofOther);
    }
    return sum;
}

} // namespace

double SlantNoise::lossScale(const Slants& slants, double focal) const
{
    std::vector<double> lengths = slants.length;
    std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
    const double scale = std::hypot(lean, pixels / focal / lengths[lengths.size() / 2]);
    // Half the square of it is the logarithm of how much less probable the slant is than none.
    return std::sqrt(2 * std::log1p((1 - share) / share * otherLean / scale));
}

static void keepBetter(const Slants& slants, double focal, int steps, SlantNoise noise, SlantNoise& best)
{
    for (int i = 0; i < steps; i++)
        improve(slants, noise.pixels / focal, noise);
    noise.logLikelihood = logLikelihood(slants, noise.pixels / focal, noise);
    if (noise.logLikelihood > best.logLikelihood)
        best = noise;
}

SlantNoise fitSlantNoise(const Slants& slants, double focal, const SlantNoise* start)
{
    // The likelihood has a maximum with few, exact verticals, and one with many that lean.
    const double leans[] = {PRIOR_LEAN, PRIOR_LEAN / 8}, shares[] = {0.3, 0.5};
    const int few = 6, more = 6;
    SlantNoise best = SlantNoise();
    best.logLikelihood = -DBL_MAX;
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < (start ? 1 : 4); j++)
        {
            const SlantNoise noise = {start ? start->pixels : DETECTOR_ERRORS[j], leans[k], shares[k], OTHER_LEAN, 0};
            keepBetter(slants, focal, few, noise, best);
        }
    keepBetter(slants, focal, more, best, best);
    return best;
}

double logLikelihoodWithoutVerticals(const Slants& slants)
{
    const int steps = 12;
    double scale = OTHER_LEAN;
    for (int step = 0; step < steps; step++)
    {
        double squares = 0;
        for (size_t i = 0; i < slants.size(); i++)
            squares += StudentT(slants.slant[i], scale * scale).weighedSquare(slants.slant[i]);
        scale = scaleOf(squares, double(slants.size()), OTHER_LEAN);
    }
    const double unusual = std::log(scale / OTHER_LEAN);
    double sum = -0.5 * unusual * unusual;
    for (size_t i = 0; i < slants.size(); i++)
        sum += std::log(StudentT(slants.slant[i], scale * scale).density);
    return sum;
}

double dependenceOf(double rollSigma)
{
    return 1 + (DEPENDENCE - 1) * std::min(1., rollSigma / HIDING_ROLL);
}

}} // namespace cv::rsackermann
