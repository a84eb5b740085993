// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/factors/slant_noise.hpp"

namespace opencv_test { namespace {

const double FOCAL = 1000, OTHER_LEAN = 8 * degree;

//! Student's t with three degrees of freedom.
double student(RNG& rng)
{
    const double a = rng.gaussian(1), b = rng.gaussian(1), c = rng.gaussian(1);
    return rng.gaussian(1) / std::sqrt((a * a + b * b + c * c) / 3);
}

void addSlant(double slant, double pixels, Slants& slants)
{
    slants.slant.push_back(slant);
    slants.length.push_back(pixels / FOCAL);
}

//! Slants of verticals that lean by student() * lean and are placed to student() * pixels, among others.
Slants drawSlants(int count, double lean, double pixels, double share, RNG& rng)
{
    Slants slants;
    for (int i = 0; i < count; i++)
    {
        const double length = rng.uniform(40., 300.), scale = std::hypot(lean, pixels / length);
        addSlant((rng.uniform(0., 1.) < share ? OTHER_LEAN : scale) * student(rng), length, slants);
    }
    return slants;
}

TEST(RSAckermann_SlantNoise, finds_what_was_drawn)
{
    RNG rng(3);
    const double leans[] = {0.1, 0.3}, shares[] = {0.05, 0.3, 0.6};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++)
        {
            const SlantNoise noise = fitSlantNoise(drawSlants(2000, leans[i] * degree, 0.15, shares[j], rng), FOCAL);
            EXPECT_NEAR(leans[i] * degree, noise.lean, 0.2 * leans[i] * degree) << i << " " << j;
            EXPECT_NEAR(shares[j], noise.share, 0.07) << i << " " << j;
            const double fewOthers = shares[j] < 0.3 ? 0.5 : 0.2;
            EXPECT_NEAR(OTHER_LEAN, noise.otherLean, fewOthers * OTHER_LEAN) << i << " " << j;
        }
}

TEST(RSAckermann_SlantNoise, finds_the_error_of_the_detector)
{
    RNG rng(4);
    const double pixels[] = {0.05, 0.15, 0.4};
    for (int i = 0; i < 3; i++)
        EXPECT_NEAR(pixels[i], fitSlantNoise(drawSlants(2000, 0.03 * degree, pixels[i], 0.1, rng), FOCAL).pixels,
                    0.02 * pixels[i]);
}

// One slant in forty that is another one changes the detector's error a little: it doesn't jump.
TEST(RSAckermann_SlantNoise, nearly_alike)
{
    RNG rng(8);
    std::vector<double> changes;
    for (int i = 0; i < 200; i++)
    {
        const Slants slants = drawSlants(80, 0.3 * degree, 0.15, 0.3, rng),
                     others = drawSlants(2, 0.3 * degree, 0.15, 0.3, rng);
        Slants alike = slants;
        for (int k = 0; k < 2; k++)
        {
            alike.slant[k] = others.slant[k];
            alike.length[k] = others.length[k];
        }
        changes.push_back(std::abs(std::log(fitSlantNoise(slants, FOCAL).pixels / fitSlantNoise(alike, FOCAL).pixels)));
    }
    std::sort(changes.begin(), changes.end());
    RecordProperty("change_p95", format("%.3f", changes[190]));
    EXPECT_LT(changes[190], 0.7); // most numbers that are tried are three or ten times as large as the next one
}

// From where it was found it is found again, whichever of its maxima is the larger one, as far as a few steps of
// expectation and maximisation go.
TEST(RSAckermann_SlantNoise, from_what_was_found_before)
{
    RNG rng(5);
    for (const double lean : {0.01, 0.3})
        for (const double pixels : {0.005, 0.05, 0.4})
            for (const double share : {0.1, 0.6})
            {
                const Slants slants = drawSlants(100, lean * degree, pixels, share, rng);
                const SlantNoise found = fitSlantNoise(slants, FOCAL), again = fitSlantNoise(slants, FOCAL, &found);
                EXPECT_NEAR(found.pixels, again.pixels, 1e-12);
                EXPECT_NEAR(found.lean, again.lean, 0.03 * found.lean);
                EXPECT_NEAR(found.logLikelihood, again.logLikelihood, 0.05);
            }
}

TEST(RSAckermann_SlantNoise, few_segments_are_as_usual)
{
    Slants one;
    addSlant(1e-5, 200, one);
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
    const double unusual = std::log(noise.lean / (0.3 * degree)),
                 otherUnusual = std::log(noise.otherLean / (3 * degree));
    double expected = -0.5 * (unusual * unusual + otherUnusual * otherUnusual);
    const auto student = [](double x) {
        return std::tgamma(2.) / (std::tgamma(1.5) * std::sqrt(3 * CV_PI)) * std::pow(1 + x * x / 3, -2);
    };
    for (size_t i = 0; i < slants.size(); i++)
    {
        const double scale = std::hypot(noise.lean, noise.pixels / (FOCAL * slants.length[i]));
        expected += std::log((1 - noise.share) * student(slants.slant[i] / scale) / scale +
                             noise.share * student(slants.slant[i] / noise.otherLean) / noise.otherLean);
    }
    EXPECT_NEAR(expected, noise.logLikelihood, 1e-8);
}

// An uncertain roll hides what verticals share.
TEST(RSAckermann_SlantNoise, dependence)
{
    EXPECT_EQ(1, dependenceOf(0));
    EXPECT_NEAR(2, dependenceOf(0.25 * degree), 1e-9);
    EXPECT_NEAR(5, dependenceOf(1 * degree), 1e-9);
    EXPECT_NEAR(5, dependenceOf(2 * degree), 1e-9);
}

// Where the loss of a vertical ends, that of another line begins.
TEST(RSAckermann_SlantNoise, loss_ends_where_other_lines_are_as_probable)
{
    Slants slants;
    for (int i = 0; i < 5; i++)
        addSlant(0, 200, slants);
    SlantNoise noise = {0.15, 0.3 * degree, 0.5, 6 * degree, 0};
    const double scale = std::hypot(0.3 * degree, 0.15 / 200);
    EXPECT_NEAR(std::sqrt(2 * std::log(1 + 6 * degree / scale)), noise.lossScale(slants, FOCAL), 1e-12);
    // The fewer are verticals, the less a line that fits says.
    double last = DBL_MAX;
    for (noise.share = 0.05; noise.share < 1; noise.share += 0.1)
    {
        EXPECT_LT(noise.lossScale(slants, FOCAL), last);
        last = noise.lossScale(slants, FOCAL);
    }
    EXPECT_LT(last, 1.25);
}

}} // namespace
