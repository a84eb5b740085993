// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_private_problem.hpp"
#include "../src/single/peak_moments.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! The motion whose walls are turned and pass faster.
Model moved(Model m, const Vec3d& step)
{
    const double c = std::exp(step[1]) * std::cos(step[0]), s = std::exp(step[1]) * std::sin(step[0]);
    const Vec2d wall(m[P_B], m[P_D]);
    m[P_B] = c * wall[0] - s * wall[1];
    m[P_D] = s * wall[0] + c * wall[1];
    m[P_LAMBDA] *= std::exp(step[2] - step[1]);
    return m;
}

//! Mean and covariance of the azimuth of two walls and of the logarithms of how fast they pass.
struct WallMoments
{
    Vec3d mean; // as a step from a minimum
    Matx33d covariance;

    WallMoments(const Fit& fit, const Model& minimum)
    {
        const auto logsOf = [](const Model& m) {
            const double left = std::log(std::hypot(m[P_B], m[P_D]));
            return Vec3d(std::atan2(m[P_D], m[P_B]), left, left + std::log(m[P_LAMBDA]));
        };
        mean = logsOf(fit.model) - logsOf(minimum);
        const double square = std::pow(fit.model[P_B], 2) + std::pow(fit.model[P_D], 2), B = fit.model[P_B] / square,
                     D = fit.model[P_D] / square;
        const Matx33d J(-D, B, 0, B, D, 0, B, D, 1 / fit.model[P_LAMBDA]);
        covariance = J * fit.covariance.get_minor<3, 3>(P_B, P_B) * J.t();
    }

    //! The truth, on a grid along the axes of the normal distribution.
    WallMoments(const RefinementProblem& problem, const Fit& minimum) : covariance(Matx33d::zeros())
    {
        const Matx33d normal = WallMoments(minimum, minimum.model).covariance;
        Vec3d squares;
        Matx33d axes;
        eigen(normal, squares, axes);
        const int steps = 10;
        const double width = 0.5; // sigmas
        double sum = 0;
        for (int i = 0; i < std::pow(2 * steps + 1, 3); i++)
        {
            const int side = 2 * steps + 1;
            Vec3d step;
            for (int k = 0, place = i; k < 3; k++, place /= side)
                step += width * (place % side - steps) * std::sqrt(squares[k]) * axes.row(k).t();
            const Model model = moved(minimum.model, step);
            const double weight = std::exp((minimum.cost - costOf(problem, minimum.hypothesis, model)) / 2);
            sum += weight;
            mean += weight * step;
            covariance += weight * step * step.t();
        }
        mean *= 1 / sum;
        covariance = covariance * (1 / sum) - mean * mean.t();
    }
};

//! A street between walls, whose yaw rate and direction of gravity are known.
struct Street
{
    AckermannEstimator::Params params;
    RollingShutterCamera camera;
    DrivingPrior prior;
    RefinementProblem problem;
    Fit fit;

    Street(int verticals, double noise, RNG& rng)
        : params(exactGravity()), camera(simulation::paperCamera()), prior(MotionPrior(), camera, params),
          problem(makeProblem(camera, params, segmentsOf(camera, verticals, noise, rng))),
          fit(MotionHypothesis(MODEL_3LA, 2))
    {
        problem.sigma = noise;
        problem.prior = &prior;
        problem.noiseIsKnown = true;
        problem.weigh();
        fit.model = modelOf(simulator(camera));
        fit.refine(problem);
    }

private:
    static AckermannEstimator::Params exactGravity()
    {
        AckermannEstimator::Params params;
        params.gravitySigma = 0;
        return params;
    }

    static Simulator simulator(const RollingShutterCamera& camera)
    {
        return Simulator::fromMetric(camera, 0, 20, 3, 2.5, 0.02);
    }

    static Mat segmentsOf(const RollingShutterCamera& camera, int count, double noise, RNG& rng)
    {
        simulation::SegmentOptions options;
        options.count = count;
        options.noise = noise;
        return simulation::randomSegments(simulator(camera), options, rng).ends;
    }
};

// Few verticals and a robust loss: the peak is skewed, and has tails.
TEST(RSAckermann_PeakMoments, are_those_of_the_peak)
{
    RNG rng(1);
    double missed[2] = {0, 0}, misjudged[2] = {0, 0}; // by the normal distribution, and by its integral
    const int peaks = 30;
    for (int i = 0; i < peaks; i++)
    {
        const Street street(40, 0.5, rng);
        ASSERT_LT(street.fit.cost, DBL_MAX);
        Fit peak = street.fit;
        integratePeak(street.problem, peak);
        const WallMoments truth(street.problem, street.fit);
        const WallMoments found[2] = {WallMoments(street.fit, street.fit.model), WallMoments(peak, street.fit.model)};
        for (int k = 0; k < 2; k++)
            for (int j = 0; j < 3; j++)
            {
                const double variance = truth.covariance(j, j);
                missed[k] += std::abs(found[k].mean[j] - truth.mean[j]) / std::sqrt(variance) / (3 * peaks);
                misjudged[k] += std::abs(std::log(found[k].covariance(j, j) / variance)) / 2 / (3 * peaks);
            }
    }
    RecordProperty("mean_missed", cv::format("%.3f %.3f", missed[0], missed[1]).c_str());
    RecordProperty("sigma_misjudged", cv::format("%.3f %.3f", misjudged[0], misjudged[1]).c_str());
    EXPECT_LT(missed[1], 0.7 * missed[0]);
    EXPECT_LT(misjudged[1], 0.9 * misjudged[0]);
}

TEST(RSAckermann_PeakMoments, of_a_normal_distribution_are_its_own)
{
    RNG rng(2);
    for (int i = 0; i < 10; i++)
    {
        Street street(400, 0.02, rng);
        street.problem.lossScale = 1000;
        street.fit.refine(street.problem);
        Fit peak = street.fit;
        integratePeak(street.problem, peak);
        for (int p = 0; p < PARAMETERS; p++)
        {
            const double sigma = std::sqrt(street.fit.covariance(p, p));
            // A hundredth is that of single precision.
            EXPECT_NEAR(street.fit.model.value[p], peak.model.value[p], 0.06 * sigma);
            EXPECT_NEAR(sigma, std::sqrt(peak.covariance(p, p)), 0.02 * sigma);
        }
    }
}

// What isn't free stays what it is, and a fit that failed, too.
TEST(RSAckermann_PeakMoments, of_unknowns_that_are_not_free)
{
    RNG rng(3);
    const Street street(20, 0.5, rng);
    Fit rest(MotionHypothesis(MODEL_NONE, 0));
    rest.refine(street.problem);
    Fit peak = rest;
    integratePeak(street.problem, peak);
    EXPECT_EQ(0, cv::norm(peak.model.value, rest.model.value));
    EXPECT_EQ(0, cv::norm(peak.covariance, rest.covariance));
    Fit failed = street.fit;
    failed.cost = DBL_MAX;
    peak = failed;
    integratePeak(street.problem, peak);
    EXPECT_EQ(0, cv::norm(peak.covariance, failed.covariance));
}

}} // namespace opencv_test
