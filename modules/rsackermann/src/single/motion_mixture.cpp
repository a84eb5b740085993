// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "motion_mixture.hpp"
#include "motion_samples.hpp"

namespace cv { namespace rsackermann {

void MotionMixture::add(const Fit& fit, const MotionHypothesis& hypothesis, double logWeight)
{
    if (!(logWeight > -DBL_MAX && logWeight < DBL_MAX))
        return;
    const Component c = {fit.model, hypothesis, fit.covariance, logWeight};
    components.push_back(c);
    largest_ = std::max(largest_, logWeight);
}

std::vector<double> MotionMixture::probabilities() const
{
    double sum = 0;
    std::vector<double> probability(components.size());
    for (size_t i = 0; i < components.size(); i++)
        sum += probability[i] = std::exp(components[i].logWeight - largest_);
    for (size_t i = 0; i < components.size(); i++)
        probability[i] /= sum;
    return probability;
}

// The loss is convex in the fraction of the correction that is applied: golden-section search.
static double bestFraction(const MotionSamples& samples, const Correction& correction, double harmAversion)
{
    const double golden = (std::sqrt(5.) - 1) / 2;
    const int steps = 14;
    const auto loss = [&](double fraction) {
        const MotionSamples::Expectation e = samples.expect(correction.scaled(fraction));
        return e.residual + harmAversion * e.harm;
    };
    double low = 0, high = 1, a = high - golden, b = low + golden, lossA = loss(a), lossB = loss(b);
    for (int step = 0; step < steps; step++)
    {
        if (lossA < lossB)
        {
            high = b;
            b = a;
            lossB = lossA;
            a = high - golden * (high - low);
            lossA = loss(a);
        }
        else
        {
            low = a;
            a = b;
            lossA = lossB;
            b = low + golden * (high - low);
            lossB = loss(b);
        }
    }
    const double least = 1e-3; // pixels: by less nothing is to be gained
    const double best = loss(1) < loss((low + high) / 2) + least ? 1 : (low + high) / 2;
    return loss(best) < loss(0) - least ? best : 0;
}

Posterior MotionMixture::best() const
{
    const std::vector<double> probability = probabilities();
    MotionSamples samples(field, prior, contact);
    for (size_t i = 0; i < components.size(); i++)
        if (probability[i] > NEGLIGIBLE)
            samples.add(components[i].model, components[i].covariance, probability[i]);
    Correction correction = samples.middleOfMoving();
    correction = correction.scaled(bestFraction(samples, correction, harmAversion));
    const MotionSamples::Expectation expected = samples.expect(correction);

    Posterior result;
    result.model = correction.model;
    result.G = correction.G;
    result.expectedRaw = expected.raw;
    result.expectedResidual = expected.residual;
    result.probabilityWorse = expected.probabilityWorse;
    double translating[3] = {0, 0, 0};
    for (size_t i = 0; i < components.size(); i++)
    {
        const Component& c = components[i];
        Vec<double, PARAMETERS> difference;
        for (int p = 0; p < PARAMETERS; p++)
            difference[p] = c.model.value[p] - result.model.value[p];
        result.covariance += probability[i] * (c.covariance + difference * difference.t());
        translating[c.hypothesis.walls] += c.hypothesis.translates() ? probability[i] : 0;
    }
    result.hypothesis =
        MotionHypothesis(field.mainMotion(result.model, result.G), translating[2] > translating[1] ? 2 : 1);
    return result;
}

}} // namespace cv::rsackermann
