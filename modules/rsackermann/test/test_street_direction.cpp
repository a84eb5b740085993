// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_private_problem.hpp"
#include "../src/single/refinement.hpp"

namespace opencv_test { namespace {

using simulation::Simulator;

//! A wide camera.
RollingShutterCamera wideCamera(double heading)
{
    RollingShutterCamera camera = simulation::paperCamera();
    camera.cameraMatrix(0, 0) = camera.cameraMatrix(1, 1) = 180;
    camera.heading = heading;
    return camera;
}

// Lines along a street at an angle, on the road and the walls, as a camera at rest sees them.
TEST(RSAckermann_StreetDirection, is_found_at_every_angle)
{
    const RollingShutterCamera camera = wideCamera(0);
    const double angles[] = {-0.75, -0.4, 0, 0.3, 0.75};
    for (int k = 0; k < 5; k++)
    {
        const Vec3d along(std::sin(angles[k]), 0, std::cos(angles[k])), across(along[2], 0, -along[0]);
        const Simulator still(camera, simulation::Drive(), simulation::Street());
        Mat segments(0, 4, CV_64F);
        for (int i = -4; i <= 4; i++)
            for (int side = 0; side < 2; side++)
            {
                // beside the car on the road, and above it on a wall
                const Vec3d offset = side ? Vec3d(across * (i < 0 ? -3. : 3.) + Vec3d(0, -0.4 * (std::abs(i) + 1), 0))
                                          : Vec3d(across * (0.8 * i) + Vec3d(0, 1.2, 0));
                Point2d u, v;
                if (!still.projectAt(offset + along * 5, 0, u) || !still.projectAt(offset + along * 12, 0, v) ||
                    !still.inside(u) || !still.inside(v))
                    continue;
                Mat row(Matx14d(u.x, u.y, v.x, v.y));
                segments.push_back(row);
            }
        RefinementProblem problem = makeProblem(camera, AckermannEstimator::Params(), segments);
        problem.directionSigma = 1;
        ASSERT_GE(problem.others.size(), 5u) << k;
        Model model;
        // It isn't another start if it is where the model was.
        ASSERT_EQ(angles[k] != 0, startFromStreetDirection(problem, MotionHypothesis(MODEL_1LA, 0), model)) << k;
        EXPECT_NEAR(angles[k], model[P_STREET], 0.011) << k; // the step of the search
        // Walls keep the side on which they are.
        for (int sign = -1; sign <= 1; sign += 2)
        {
            Model walls;
            walls.direction = 1;
            walls[P_B] = 0.2 * sign;
            ASSERT_EQ(angles[k] != 0, startFromStreetDirection(problem, MotionHypothesis(MODEL_3LA, 1), walls)) << k;
            EXPECT_NEAR(0.2 * sign * std::cos(model[P_STREET]), walls[P_B], 0.01) << k;
            EXPECT_NEAR(0.2 * sign * std::sin(model[P_STREET]), walls[P_D], 0.01) << k;
        }
        problem.others.clear();
        problem.arrange();
        EXPECT_FALSE(startFromStreetDirection(problem, MotionHypothesis(MODEL_1LA, 0), model)) << k;
    }
}

}} // namespace
