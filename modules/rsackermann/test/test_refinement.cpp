// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_private_problem.hpp"
#include "../src/factors/segment_residuals.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

AckermannEstimator::Params exactGravity()
{
    AckermannEstimator::Params params;
    params.gravitySigma = 0;
    return params;
}

RefinementProblem streetProblem(const Simulator& street, double noise, int count,
                                const AckermannEstimator::Params& params, int seed)
{
    RNG rng(seed);
    simulation::SegmentOptions options;
    options.count = count;
    options.noise = noise;
    return makeProblem(street.camera, params, simulation::randomSegments(street, options, rng).ends);
}

// Without segments the covariance of gravity is what is known of it: of the vehicle's roll and pitch, not of the
// camera's.
TEST(RSAckermann_Refinement, covariance_of_gravity_alone)
{
    for (int k = 0; k < 3; k++)
    {
        RollingShutterCamera camera = simulation::paperCamera();
        camera.heading = k * 45 * degree;
        const double roll = 0.02, pitch = 0.005, c = std::cos(camera.heading), s = std::sin(camera.heading);
        AckermannEstimator::Params params;
        params.gravitySigma = roll;
        params.vehiclePitchSigma = pitch;
        const RefinementProblem problem = makeProblem(camera, params, Mat(0, 4, CV_64F));
        Model model;
        Matx<double, PARAMETERS, PARAMETERS> covariance;
        refine(problem, MotionHypothesis(MODEL_NONE, 0), ALL_SEGMENTS, 10, model, &covariance);
        EXPECT_NEAR(c * c * roll * roll + s * s * pitch * pitch, covariance(P_ROLL, P_ROLL), 1e-9) << k;
        EXPECT_NEAR(s * s * roll * roll + c * c * pitch * pitch, covariance(P_PITCH, P_PITCH), 1e-9) << k;
        EXPECT_NEAR(covariance(P_ROLL, P_ROLL), problem.rollSigma() * problem.rollSigma(), 1e-9) << k;
        EXPECT_NEAR(c * s * (pitch * pitch - roll * roll), covariance(P_ROLL, P_PITCH), 1e-9) << k;
    }
}

// If the loss is quadratic: the covariance of dense normal equations with derivatives by differences.
TEST(RSAckermann_Refinement, covariance_of_least_squares)
{
    const Simulator street = Simulator::fromMetric(simulation::paperCamera(), 0.5, 20, 2.5, 3, 0);
    const int count = 14;
    RefinementProblem problem = streetProblem(street, 0.3, count, exactGravity(), 3);
    ASSERT_EQ(size_t(count), problem.verticals.size());
    problem.lossScale = 1e4;
    problem.weigh();
    const MotionHypothesis hypothesis(MODEL_4LA, 2);
    Fit fit(hypothesis);
    fit.model = modelOf(street);
    fit.refine(problem);
    const Model& model = fit.model;
    const Matx<double, PARAMETERS, PARAMETERS>& covariance = fit.covariance;

    const int n = hypothesis.unknowns();
    Mat1d J(count, n);
    const double scale = problem.focal / problem.sigma, h = 1e-6;
    for (int i = 0; i < count; i++)
    {
        int wall;
        const UprightSegment& c = problem.verticals[i];
        for (int j = 0; j < n; j++)
        {
            Model up = model, down = model;
            up.value[j] += h;
            down.value[j] -= h;
            J(i, j) = scale *
                      (verticalResidual(c, up, problem.heading, wall, 0) -
                       verticalResidual(c, down, problem.heading, wall, 0)) /
                      (2 * h);
        }
    }
    const Mat1d normal = J.t() * J, expected = normal.inv();
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            EXPECT_NEAR(expected(i, j), covariance(i, j), 0.02 * std::sqrt(expected(i, i) * expected(j, j)))
                << i << " " << j;
}

}} // namespace
