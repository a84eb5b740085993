// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_simulator.hpp"
#include "../src/estimator/motion_mixture.hpp"

namespace opencv_test { namespace {

class MixtureOfMotions : public testing::Test
{
protected:
    MixtureOfMotions()
        : camera(simulation::paperCamera()), field(camera), usual(MotionPrior(), camera, AckermannEstimator::Params(),
                                                                  MotionLimits(camera, AckermannEstimator::Params())),
          mixture(field, usual)
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

    void add(const Fit& fit, double probability) { mixture.add(fit, fit.hypothesis, 700 + std::log(probability)); }

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
    UsualDrive usual;
    MotionMixture mixture;
};

TEST_F(MixtureOfMotions, of_one_is_that_one)
{
    add(turning(0.01, 0.001), 1);
    const Posterior best = mixture.best();
    EXPECT_NEAR(0.01, best.model[P_ALPHA], 1e-15);
    EXPECT_NEAR(1e-6, best.covariance(P_ALPHA, P_ALPHA), 1e-15);
    EXPECT_EQ(MODEL_1LA, best.hypothesis.motion);
    EXPECT_GT(best.expectedRaw, displacement(0.01)); // the mean of what is uncertain
    EXPECT_NEAR(std::sqrt(2 / CV_PI) * displacement(0.001), best.expectedLeft, 1e-9);
}

// Along one line the geometric median is the median: what has more than half of the probability wins, whatever the
// others are.
TEST_F(MixtureOfMotions, the_majority_decides)
{
    add(turning(0.01), 0.6);
    add(turning(0.05), 0.4);
    const Posterior best = mixture.best();
    EXPECT_NEAR(0.01, best.model[P_ALPHA], 2e-3);
    EXPECT_NEAR(0.6 * displacement(0.01) + 0.4 * displacement(0.05), best.expectedRaw, 1e-9);
    const double left = 0.6 * displacement(best.model[P_ALPHA] - 0.01) + 0.4 * displacement(0.05 - best.model[P_ALPHA]);
    EXPECT_NEAR(left, best.expectedLeft, 1e-9);
    const double a = best.model[P_ALPHA] - 0.01, b = best.model[P_ALPHA] - 0.05;
    EXPECT_NEAR(0.6 * a * a + 0.4 * b * b, best.covariance(P_ALPHA, P_ALPHA), 1e-12);
}

TEST_F(MixtureOfMotions, the_middle_of_three)
{
    add(turning(-0.02), 0.3);
    add(turning(0.012), 0.4);
    add(turning(0.03), 0.3);
    EXPECT_NEAR(0.012, mixture.best().model[P_ALPHA], 1e-3);
}

TEST_F(MixtureOfMotions, rest_with_the_majority_leaves_the_image)
{
    add(Fit(MotionHypothesis(MODEL_NONE, 0)), 0.7);
    add(turning(0.04), 0.3);
    const Posterior best = mixture.best();
    EXPECT_LT(std::abs(best.model[P_ALPHA]), 2e-3);
    EXPECT_NEAR(0.3 * displacement(0.04), best.expectedRaw, 1e-9);
}

// Usual values alone make a correction that is expected to help, since cars mostly move. It is applied if the image
// speaks against rest, or if a motion is told.
TEST_F(MixtureOfMotions, usual_values_alone_correct_nothing)
{
    MotionPrior prior;
    prior.speed = 10;
    prior.speedSigma = 1;
    const UsualDrive told(prior, camera, AckermannEstimator::Params(),
                          MotionLimits(camera, AckermannEstimator::Params()));
    const double rests[] = {0.3, 0.36};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
        {
            MotionMixture two(field, k ? told : usual);
            two.add(Fit(MotionHypothesis(MODEL_NONE, 0)), MotionHypothesis(MODEL_NONE, 0), std::log(rests[i]));
            two.add(turning(0.04), turning(0.04).hypothesis, std::log(1 - rests[i]));
            const Posterior best = two.best();
            // Rest has a probability of 1/3 before anything is seen
            EXPECT_NEAR(k ? 0 : 3 * rests[i], best.restRatio, 1e-9);
            EXPECT_LT(best.expectedLeft, best.expectedRaw);
            EXPECT_EQ(i == 0 || k == 1, best.helps()) << i << " " << k;
        }
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
    EXPECT_NEAR((1 - t) * 0.05 + t * 0.45, best.model[P_LAMBDA] * best.model[P_B], 1e-9);
    EXPECT_EQ(1, best.model.direction);
    EXPECT_EQ(2, best.hypothesis.walls);
    EXPECT_EQ(MODEL_3LA, best.hypothesis.motion);
    double G[2], variance;
    usual.road(moving(0.1, 0.5).model, RoadContact(), G[0], variance);
    usual.road(moving(0.3, 1.5).model, RoadContact(), G[1], variance);
    EXPECT_NEAR((1 - t) * G[0] + t * G[1], best.G, 1e-9);
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
    mixture.add(turning(0.05), MotionHypothesis(MODEL_1LA, 0), NaN);
    mixture.add(turning(0.05), MotionHypothesis(MODEL_1LA, 0), infinity);
    mixture.add(turning(0.05), MotionHypothesis(MODEL_1LA, 0), -infinity);
    EXPECT_NEAR(0.01, mixture.best().model[P_ALPHA], 1e-15);
}

}} // namespace
