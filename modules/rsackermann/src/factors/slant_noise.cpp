// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../optim/median.hpp"
#include "residual_kernels.hpp"

namespace cv { namespace rsackermann {

static const double OTHER_LEAN = 3 * CV_PI / 180;                 // usual scale for lines that aren't vertical
static const double DISTINCT = 2;                                 // least ratio of both scales
static const double DETECTOR_ERRORS[] = {0.005, 0.05, 0.15, 0.4}; // pixels that are tried

namespace {

// Logarithmic mean of a measured scale, which counts as often as it was seen, and of the usual one, which counts once.
double scaleOf(double squares, double count, double usual)
{
    const double measured = 0.5 * std::log(std::max(squares / std::max(count, DBL_MIN), 1e-12));
    return std::exp((count * measured + std::log(usual)) / (count + 1));
}

// One step of expectation and maximisation.
void improve(const Slants& slants, double error, SlantNoise& noise)
{
    const SlantSums sums = sumSlants(slants, noise, error);
    const double count = double(slants.size()), others = count - sums.verticals;
    noise.share = std::min(0.95, (others + 1) / (count + 2));
    noise.lean = scaleOf(sums.squares, sums.verticals, PRIOR_LEAN);
    noise.otherLean = std::max(DISTINCT * noise.lean, scaleOf(sums.otherSquares, others, OTHER_LEAN));
}

double logLikelihood(const Slants& slants, double error, const SlantNoise& noise)
{
    const double unusual = std::log(noise.lean / PRIOR_LEAN), otherUnusual = std::log(noise.otherLean / OTHER_LEAN);
    return slantLikelihood(slants, noise, error) - 0.5 * (unusual * unusual + otherUnusual * otherUnusual);
}

} // namespace

double SlantNoise::lossScale(const Slants& slants, double focal) const
{
    std::vector<double> lengths = slants.length;
    const double scale = std::hypot(lean, pixels / focal / medianOf(lengths.begin(), lengths.end()));
    // Half the square of it is the logarithm of how much less probable the slant is than none.
    return std::sqrt(2 * std::log1p((1 - share) / share * otherLean / scale));
}

static SlantNoise improved(const Slants& slants, double focal, int steps, SlantNoise noise)
{
    for (int i = 0; i < steps; i++)
        improve(slants, noise.pixels / focal, noise);
    noise.logLikelihood = logLikelihood(slants, noise.pixels / focal, noise);
    return noise;
}

SlantNoise fitSlantNoise(const Slants& slants, double focal, const SlantNoise* start)
{
    // The likelihood has a maximum with few, exact verticals, and one with many that lean.
    const double leans[] = {PRIOR_LEAN, PRIOR_LEAN / 8}, shares[] = {0.3, 0.5};
    const int few = 6, more = 6;
    std::vector<SlantNoise> noises;
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < (start ? 1 : 4); j++)
        {
            const SlantNoise noise = {start ? start->pixels : DETECTOR_ERRORS[j], leans[k], shares[k], OTHER_LEAN, 0};
            noises.push_back(improved(slants, focal, few, noise));
        }
    SlantNoise best = *std::max_element(noises.begin(), noises.end(), [](const SlantNoise& a, const SlantNoise& b) {
        return a.logLikelihood < b.logLikelihood;
    });
    // The likelihood hardly depends on the detector's error: the most likely one of those that are tried would jump
    // from an image to one that is nearly the same, their mean square doesn't.
    double sum = 0, squares = 0;
    for (const SlantNoise& noise : noises)
    {
        const double weight = std::exp(noise.logLikelihood - best.logLikelihood);
        sum += weight;
        squares += weight * noise.pixels * noise.pixels;
    }
    best.pixels = std::sqrt(squares / sum);
    return improved(slants, focal, more, best);
}

static SlantDensity<double> densityOf(double slant, double scale)
{
    return SlantDensity<double>(scale, scale * scale, slant * slant);
}

double logLikelihoodWithoutVerticals(const Slants& slants)
{
    const int steps = 12;
    double scale = OTHER_LEAN;
    for (int step = 0; step < steps; step++)
    {
        double squares = 0;
        for (size_t i = 0; i < slants.size(); i++)
            squares += densityOf(slants.slant[i], scale).weighedSquare();
        scale = scaleOf(squares, double(slants.size()), OTHER_LEAN);
    }
    const double unusual = std::log(scale / OTHER_LEAN);
    double sum = -0.5 * unusual * unusual;
    for (size_t i = 0; i < slants.size(); i++)
        sum += std::log(densityOf(slants.slant[i], scale).value);
    return sum;
}

double dependenceOf(double rollSigma)
{
    // What verticals share is hidden by a roll that isn't known: the one of a camera that isn't level by default.
    const double hiding = AckermannEstimator::Params().gravitySigma;
    return 1 + (DEPENDENCE - 1) * std::min(1., rollSigma / hiding);
}

}} // namespace cv::rsackermann
