// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/estimator/slant_noise.hpp"

namespace opencv_test { namespace {

const double FOCAL = 1000, GATE = 0.3;

Slants noSlants()
{
    const MotionLimits limits(simulation::paperCamera(), AckermannEstimator::Params());
    return Slants(RefinementProblem(limits), Model(), false);
}

//! Student's t with three degrees of freedom.
double student(RNG& rng)
{
    const double a = rng.gaussian(1), b = rng.gaussian(1), c = rng.gaussian(1);
    return rng.gaussian(1) / std::sqrt((a * a + b * b + c * c) / 3);
}

void addSlant(double slant, double pixels, double column, Slants& slants)
{
    slants.slant.push_back(slant);
    slants.length.push_back(pixels / FOCAL);
    slants.gate.push_back(GATE);
    slants.column.push_back(column);
}

//! Slants of verticals that lean by student() * lean and are placed to student() * pixels, among others; so that no two
//! are neighbours.
Slants drawSlants(int count, double lean, double pixels, double share, RNG& rng)
{
    Slants slants = noSlants();
    for (int i = 0; i < count; i++)
    {
        const double length = rng.uniform(40., 300.), scale = std::hypot(lean, pixels / length);
        addSlant(rng.uniform(0., 1.) < share ? rng.uniform(-GATE, GATE) : scale * student(rng), length, i, slants);
    }
    return slants;
}

TEST(RSAckermann_SlantNoise, finds_what_was_drawn)
{
    RNG rng(3);
    const double leans[] = {0.1, 0.3, 0.9}, shares[] = {0.05, 0.3, 0.6};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
        {
            const SlantNoise noise = fitSlantNoise(drawSlants(2000, leans[i] * degree, 0.15, shares[j], rng), FOCAL);
            EXPECT_NEAR(leans[i] * degree, noise.lean, 0.2 * leans[i] * degree) << i << " " << j;
            EXPECT_NEAR(shares[j], noise.share, 0.05) << i << " " << j;
        }
}

TEST(RSAckermann_SlantNoise, finds_the_error_of_the_detector)
{
    RNG rng(4);
    const double pixels[] = {0.05, 0.15, 0.4};
    for (int i = 0; i < 3; i++)
        EXPECT_EQ(pixels[i], fitSlantNoise(drawSlants(2000, 0.03 * degree, pixels[i], 0.1, rng), FOCAL).pixels);
}

TEST(RSAckermann_SlantNoise, few_segments_are_as_usual)
{
    Slants one = noSlants();
    addSlant(1e-5, 200, 0, one);
    // One segment counts as much as what is usual.
    EXPECT_GT(fitSlantNoise(one, FOCAL).lean, 0.02 * degree);
    EXPECT_LT(fitSlantNoise(one, FOCAL).lean, 0.3 * degree);
}

// The likelihood is the product of the densities: those of the same slants with the numbers at hand.
TEST(RSAckermann_SlantNoise, likelihood)
{
    RNG rng(6);
    const Slants slants = drawSlants(50, 0.4 * degree, 0.15, 0.2, rng);
    const SlantNoise noise = fitSlantNoise(slants, FOCAL);
    const double unusual = std::log(noise.lean / (0.3 * degree));
    double expected = -0.5 * unusual * unusual;
    for (size_t i = 0; i < slants.size(); i++)
    {
        const double scale = std::hypot(noise.lean, noise.pixels / (FOCAL * slants.length[i])),
                     t = slants.slant[i] / scale;
        const double density =
            std::tgamma(2.) / (std::tgamma(1.5) * std::sqrt(3 * CV_PI)) * std::pow(1 + t * t / 3, -2);
        expected += std::log((1 - noise.share) * density / scale + noise.share / (2 * GATE));
    }
    EXPECT_NEAR(expected, noise.logLikelihood, 1e-8);
}

TEST(RSAckermann_SlantNoise, dependence)
{
    RNG rng(7);
    const double lean = 0.3 * degree;
    double neighbours;
    const Slants alone = drawSlants(1000, lean, 0.15, 0, rng);
    const SlantNoise noise = fitSlantNoise(alone, FOCAL);
    EXPECT_EQ(1, dependenceOf(alone, noise, FOCAL, neighbours)); // no two are on one facade
    EXPECT_EQ(0, neighbours);
    EXPECT_EQ(1, dependenceOf(noSlants(), noise, FOCAL, neighbours));

    // Facades, 0.03 wide, of several verticals: those that lean independently say as much as their number, those that
    // lean alike as one.
    const int facades = 500, verticals = 4;
    Slants independent = noSlants(), alike = noSlants();
    for (int i = 0; i < facades; i++)
    {
        const double common = lean * student(rng);
        for (int k = 0; k < verticals; k++)
        {
            addSlant(lean * student(rng), 200, i + 0.01 * k, independent);
            addSlant(common, 200, i + 0.01 * k, alike);
        }
    }
    EXPECT_NEAR(1, dependenceOf(independent, noise, FOCAL, neighbours), 0.2);
    EXPECT_NEAR(verticals - 1, neighbours, 1e-9);
    EXPECT_NEAR(verticals, dependenceOf(alike, noise, FOCAL, neighbours), 1e-6);
}

TEST(RSAckermann_SlantNoise, hidden_dependence)
{
    const MotionLimits limits(simulation::paperCamera(), AckermannEstimator::Params());
    SlantNoise noise = SlantNoise();
    noise.lean = 0.3 * degree;
    for (int k = 0; k < 2; k++)
    {
        // The roll of a camera that looks to a side is the vehicle's pitch.
        RefinementProblem problem(limits);
        problem.heading = Heading(k * 90 * degree);
        double& sigma = k ? problem.vehiclePitchSigma : problem.gravitySigma;
        (k ? problem.gravitySigma : problem.vehiclePitchSigma) = 0.1 * degree;
        sigma = 1 * degree;
        EXPECT_NEAR(5, hiddenDependence(problem, noise, 20), 1e-9) << k;
        EXPECT_NEAR(5, hiddenDependence(problem, noise, 60), 1e-9) << k;
        EXPECT_NEAR(3, hiddenDependence(problem, noise, 10), 1e-9) << k;
        sigma = 2 * degree;
        EXPECT_NEAR(5, hiddenDependence(problem, noise, 20), 1e-9) << k;
        sigma = 0.25 * degree;
        EXPECT_NEAR(2, hiddenDependence(problem, noise, 20), 1e-9) << k;
        noise.lean = 1.2 * degree;
        EXPECT_NEAR(17, hiddenDependence(problem, noise, 20), 1e-9) << k;
        noise.lean = 0.3 * degree;
    }
}

}} // namespace
