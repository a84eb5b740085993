// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/single/motion_mixture.hpp"

namespace opencv_test { namespace {

class MixtureOfMotions : public testing::Test
{
protected:
    MixtureOfMotions()
        : camera(simulation::paperCamera()), field(camera), prior(MotionPrior(), camera, AckermannEstimator::Params()),
          mixture(field, prior, 0)
    {
    }

    static Fit turning(double alpha, double sigma = 0)
    {
        Fit fit(MotionHypothesis(MODEL_1LA, 0));
        fit.model[P_ALPHA] = alpha;
        fit.covariance(P_ALPHA, P_ALPHA) = sigma * sigma;
        return fit;
    }

    static Fit moving(double B, double lambda)
    {
        Fit fit(MotionHypothesis(MODEL_3LA, lambda > 0 ? 2 : 1));
        fit.model[P_B] = B;
        fit.model[P_LAMBDA] = lambda;
        fit.model.direction = B < 0 ? -1 : 1;
        return fit;
    }

    void add(const Fit& fit, double probability) { mixture.add(fit, 700 + std::log(probability)); }

    //! Mean displacement by a yaw rate.
    double displacement(double alpha) const
    {
        DisplacementField::Values values;
        Model m;
        m[P_ALPHA] = alpha;
        field.displacement(m, 0, values);
        return DisplacementField::meanDistance(values, DisplacementField::Values(), DisplacementField::Variances());
    }

    RollingShutterCamera camera;
    DisplacementField field;
    DrivingPrior prior;
    MotionMixture mixture;
};

TEST_F(MixtureOfMotions, of_one_is_that_one)
{
    add(turning(0.01, 0.001), 1);
    const Posterior best = mixture.best();
    EXPECT_NEAR(0.01, best.model[P_ALPHA], 1e-15);
    EXPECT_NEAR(1e-6, best.covariance(P_ALPHA, P_ALPHA), 1e-15);
    EXPECT_EQ(MODEL_1LA, best.hypothesis.motion);
    EXPECT_NEAR(displacement(0.01), best.expectedRaw, 1e-6);
    EXPECT_NEAR(0, best.expectedResidual, 1e-4 * best.expectedRaw);
    EXPECT_EQ(0, best.probabilityWorse);
}

// Within the motions and between them.
TEST_F(MixtureOfMotions, covariance_is_that_of_all)
{
    add(turning(0.01, 0.002), 0.7);
    add(turning(0.02, 0.003), 0.3);
    const Posterior best = mixture.best();
    const double a = 0.01 - best.model[P_ALPHA], b = 0.02 - best.model[P_ALPHA];
    EXPECT_NEAR(0.7 * (4e-6 + a * a) + 0.3 * (9e-6 + b * b), best.covariance(P_ALPHA, P_ALPHA), 1e-9);
}

// On whichever side it is.
TEST_F(MixtureOfMotions, of_one_wall_is_that_wall)
{
    for (const double B : {-0.2, 0.2})
        for (const int direction : {-1, 1})
        {
            SCOPED_TRACE(testing::Message() << B << " " << direction);
            MotionMixture walls(field, prior, 0);
            for (const double larger : {1., 1.02})
            {
                Fit fit = moving(larger * B, 0);
                fit.model.direction = direction;
                walls.add(fit, 0);
            }
            const Posterior best = walls.best();
            EXPECT_NEAR(1.01 * B, best.model[P_B], 0.011 * std::abs(B));
            EXPECT_EQ(0, best.model[P_LAMBDA]);
            EXPECT_EQ(direction, best.model.direction);
        }
}

// Along one line: of the mean so much that more than half of the probability isn't exceeded.
TEST_F(MixtureOfMotions, the_majority_is_not_exceeded)
{
    add(turning(0.01), 0.6);
    add(turning(0.05), 0.4);
    const Posterior best = mixture.best();
    EXPECT_NEAR(0.01, best.model[P_ALPHA], 2e-4);
    EXPECT_NEAR(0.6 * displacement(0.01) + 0.4 * displacement(0.05), best.expectedRaw, 1e-5);
    const double left = 0.6 * displacement(best.model[P_ALPHA] - 0.01) + 0.4 * displacement(0.05 - best.model[P_ALPHA]);
    EXPECT_NEAR(left, best.expectedResidual, 1e-5);
    const double a = best.model[P_ALPHA] - 0.01, b = best.model[P_ALPHA] - 0.05;
    EXPECT_NEAR(0.6 * a * a + 0.4 * b * b, best.covariance(P_ALPHA, P_ALPHA), 1e-12);
}

// Between the mean and the median, wherever few others are.
TEST_F(MixtureOfMotions, is_the_middle_without_rest)
{
    add(Fit(MotionHypothesis(MODEL_NONE, 0)), 0.1);
    add(turning(0.030), 0.3);
    add(turning(0.033), 0.6);
    const double middle = mixture.best().model[P_ALPHA];
    EXPECT_GT(middle, 0.032);
    EXPECT_LT(middle, 0.033);
    add(turning(0.2), 0.02);
    EXPECT_NEAR(middle, mixture.best().model[P_ALPHA], 1e-3); // the mean is 3.7e-3 larger
}

TEST_F(MixtureOfMotions, rest_with_the_majority_leaves_the_image)
{
    add(Fit(MotionHypothesis(MODEL_NONE, 0)), 0.7);
    add(turning(0.04), 0.3);
    const Posterior best = mixture.best();
    EXPECT_LT(std::abs(best.model[P_ALPHA]), 2e-3);
    EXPECT_NEAR(0.3 * displacement(0.04), best.expectedRaw, 1e-5);
}

// Along one line: a fraction s of the correction leaves (1 - s) of the one motion and makes s of harm to rest.
TEST_F(MixtureOfMotions, harm_is_weighed_against_the_residual)
{
    const double aversions[] = {0, 0.3, 1, 3};
    for (int k = 0; k < 4; k++)
        for (double rest = 0.05; rest < 1; rest += 0.1)
        {
            MotionMixture two(field, prior, aversions[k]);
            two.add(Fit(MotionHypothesis(MODEL_NONE, 0)), std::log(rest));
            two.add(turning(0.04), std::log(1 - rest));
            const Posterior best = two.best();
            const double raw = (1 - rest) * displacement(0.04);
            EXPECT_NEAR(raw, best.expectedRaw, 1e-5 * raw);
            const bool helps = 1 - rest > (1 + aversions[k]) * rest;
            EXPECT_NEAR(helps ? 0.04 : 0, best.model[P_ALPHA], 4e-3) << rest << " " << aversions[k];
            EXPECT_NEAR(helps ? rest : 0, best.probabilityWorse, 1e-6);
            EXPECT_NEAR(helps ? rest * displacement(0.04) : raw, best.expectedResidual, 2e-2 * raw);
        }
}

// The road whose slope nobody sees is the more probable the flatter it is in the logarithm; what is expected is the
// mean.
TEST_F(MixtureOfMotions, the_uncertain_road_is_expected)
{
    Fit fit = moving(0.2, 1);
    add(fit, 1);
    const double exactWalls = mixture.best().expectedResidual;
    EXPECT_GT(exactWalls, 0.1);
    for (int i = P_B; i <= P_LAMBDA; i++)
        fit.covariance(i, i) = i == P_LAMBDA ? 0.01 : 0.0004;
    MotionMixture wide(field, prior, 0);
    wide.add(fit, 0);
    EXPECT_GT(wide.best().expectedResidual, 1.05 * exactWalls);
}

// There the other wall is the left one, and each is as uncertain as it was.
TEST_F(MixtureOfMotions, in_a_mirror)
{
    const double B = 0.2, D = 0.02, lambda = 0.6;
    const Matx33d spread(0.03, 0, 0, 0.01, 0.02, 0, -0.05, 0.08, 0.15), // of B, D and lambda
        change(lambda, 0, B, 0, -lambda, -D, 0, 0, -1 / (lambda * lambda)), mirrored = change * spread;
    Fit fit = moving(B, lambda), twin = moving(lambda * B, 1 / lambda);
    fit.model[P_D] = D;
    twin.model[P_D] = -lambda * D;
    MotionMixture other(field, prior, 0);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
        {
            fit.covariance(P_B + i, P_B + j) = spread.row(i).dot(spread.row(j));
            twin.covariance(P_B + i, P_B + j) = mirrored.row(i).dot(mirrored.row(j));
        }
    const Fit rest(MotionHypothesis(MODEL_NONE, 0));
    mixture.add(fit, 0);
    other.add(twin, 0);
    for (MotionMixture* m : {&mixture, &other})
        m->add(rest, -1);
    const Posterior best = mixture.best(), ofTwin = other.best();
    EXPECT_NEAR(best.expectedRaw, ofTwin.expectedRaw, 1e-4 * best.expectedRaw);
    EXPECT_NEAR(best.expectedResidual, ofTwin.expectedResidual, 1e-4 * best.expectedRaw);
    EXPECT_NEAR(best.probabilityWorse, ofTwin.probabilityWorse, 1e-6);
    EXPECT_NEAR(best.G, ofTwin.G, 1e-4 * best.G);
    const double ratio = best.model[P_LAMBDA];
    EXPECT_NEAR(1, ratio * ofTwin.model[P_LAMBDA], 1e-4);
    EXPECT_NEAR(ratio * best.model[P_B], ofTwin.model[P_B], 1e-4 * best.model[P_B]);
    EXPECT_NEAR(-ratio * best.model[P_D], ofTwin.model[P_D], 1e-4 * best.model[P_B]);
}

TEST_F(MixtureOfMotions, walls_are_averaged_as_inverse_distances)
{
    add(moving(0.1, 0.5), 0.5);
    add(moving(0.3, 1.5), 0.5);
    const Posterior best = mixture.best();
    // Whatever the weights are: the right wall's slope is the same average as the left one's.
    const double t = (best.model[P_B] - 0.1) / 0.2;
    EXPECT_GE(t, 0);
    EXPECT_LE(t, 1);
    EXPECT_NEAR((1 - t) * 0.05 + t * 0.45, best.model[P_LAMBDA] * best.model[P_B], 1e-3);
    EXPECT_EQ(1, best.model.direction);
    EXPECT_EQ(2, best.hypothesis.walls);
    EXPECT_EQ(MODEL_3LA, best.hypothesis.motion);
}

TEST_F(MixtureOfMotions, the_faster_direction_decides)
{
    add(moving(-0.3, 0), 0.6);
    add(moving(0.1, 0), 0.4);
    EXPECT_EQ(-1, mixture.best().model.direction);
    EXPECT_EQ(1, mixture.best().hypothesis.walls);
}

TEST_F(MixtureOfMotions, weights_that_are_none_do_not_count)
{
    add(turning(0.01), 1);
    mixture.add(turning(0.05), NaN);
    mixture.add(turning(0.05), infinity);
    mixture.add(turning(0.05), -infinity);
    EXPECT_NEAR(0.01, mixture.best().model[P_ALPHA], 1e-15);
}

}} // namespace
