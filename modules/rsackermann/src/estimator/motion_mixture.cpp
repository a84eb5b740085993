// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "motion_mixture.hpp"

namespace cv { namespace rsackermann {

bool Posterior::helps() const
{
    return expectedLeft < expectedRaw && restRatio <= 1;
}

void MotionMixture::add(const Fit& fit, const MotionHypothesis& hypothesis, double logWeight)
{
    if (!(logWeight > -DBL_MAX && logWeight < DBL_MAX))
        return;
    double varianceOfG;
    Component c = {fit.model,
                   hypothesis,
                   fit.covariance,
                   logWeight,
                   0,
                   DisplacementField::Values(),
                   DisplacementField::Variances()};
    usual.road(c.model, contact, c.G, varianceOfG);
    field.displacement(c.model, c.G, c.displacement);
    field.variance(c.model, c.G, varianceOfG, c.covariance, c.variance);
    components.push_back(c);
}

std::vector<double> MotionMixture::weights() const
{
    double largest = -DBL_MAX, sum = 0;
    for (size_t i = 0; i < components.size(); i++)
        largest = std::max(largest, components[i].logWeight);
    std::vector<double> weight(components.size());
    for (size_t i = 0; i < components.size(); i++)
        sum += weight[i] = std::exp(components[i].logWeight - largest);
    for (size_t i = 0; i < components.size(); i++)
        weight[i] /= sum;
    return weight;
}

// The displacement is linear in the planes and nearly so in the yaw: the planes and not their ratio are averaged.
void MotionMixture::average(const std::vector<double>& weight, Posterior& result) const
{
    Model m;
    double sum = 0, right = 0, forward = 0;
    result.G = 0;
    for (size_t i = 0; i < components.size(); i++)
    {
        const Component& c = components[i];
        const double w = weight[i];
        sum += w;
        for (int p = 0; p < PARAMETERS; p++)
            m.value[p] += w * c.model.value[p];
        right += w * c.model[P_LAMBDA] * std::hypot(c.model[P_B], c.model[P_D]);
        result.G += w * c.G;
        forward += w * c.model.direction * std::hypot(c.model[P_B], c.model[P_D]);
    }
    for (int p = 0; p < PARAMETERS; p++)
        m.value[p] /= sum;
    const double left = std::hypot(m[P_B], m[P_D]);
    m[P_LAMBDA] = left > 0 ? right / sum / left : 0;
    m.direction = forward < 0 ? -1 : 1;
    result.model = m;
    result.G /= sum;
}

Posterior MotionMixture::best() const
{
    const int steps = 12;
    const double least = 1e-3; // pixels: nearer than this nothing is to be gained
    const std::vector<double> probability = weights();
    std::vector<double> weight = probability;
    Posterior result;
    DisplacementField::Values correction, none;
    for (int step = 0; step <= steps; step++)
    {
        average(weight, result);
        field.displacement(result.model, result.G, correction);
        for (size_t i = 0; i < components.size() && step < steps; i++)
            weight[i] =
                probability[i] / std::max(least, DisplacementField::meanDistance(components[i].displacement, correction,
                                                                                 components[i].variance));
    }
    double translating[3] = {0, 0, 0}, rest = 0;
    for (size_t i = 0; i < components.size(); i++)
    {
        const Component& c = components[i];
        result.expectedRaw += probability[i] * DisplacementField::meanDistance(c.displacement, none, c.variance);
        result.expectedLeft += probability[i] * DisplacementField::meanDistance(c.displacement, correction, c.variance);
        rest += c.hypothesis.turns() || c.hypothesis.translates() ? 0 : probability[i];
        Vec<double, PARAMETERS> difference;
        for (int p = 0; p < PARAMETERS; p++)
            difference[p] = c.model.value[p] - result.model.value[p];
        result.covariance += probability[i] * (c.covariance + difference * difference.t());
        translating[c.hypothesis.walls] += c.hypothesis.translates() ? probability[i] : 0;
    }
    result.restRatio = usual.motionIsTold() ? 0 : rest / usual.restProbability();
    result.hypothesis =
        MotionHypothesis(field.mainMotion(result.model, result.G), translating[2] > translating[1] ? 2 : 1);
    return result;
}

}} // namespace cv::rsackermann
