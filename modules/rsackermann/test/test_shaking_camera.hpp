// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_SHAKING_CAMERA_HPP
#define OPENCV_TEST_RSACKERMANN_SHAKING_CAMERA_HPP

#include "test_simulator.hpp"
#include "opencv2/imgproc.hpp"

namespace opencv_test { namespace simulation {

//! Images of something far away by a camera that turns to the right while its mount shakes.
class ShakingCamera
{
public:
    cv::rsackermann::RollingShutterCamera camera = simulation::paperCamera();

    ShakingCamera() : margin(150)
    {
        RNG rng(4);
        Mat noise(camera.imageSize.height + 2 * margin, camera.imageSize.width + 6 * margin, CV_8U);
        rng.fill(noise, RNG::UNIFORM, 0, 256);
        GaussianBlur(noise, scene, Size(), 2);
        normalize(scene, scene, 0, 255, NORM_MINMAX);
        camera.lineDelay = 0.9 * interval() / camera.imageSize.height;
    }

    static double interval() { return 1. / 30; } // seconds between frames

    static double yawAt(double seconds) { return 0.2 * seconds; }
    static double pitchAt(double seconds) { return 0.01 * std::sin(2 * CV_PI * 4 * seconds); }
    static double rollAt(double seconds) { return 0.006 * std::sin(2 * CV_PI * 3 * seconds + 1); }

    //! Rates about x, y and z, which a gyro would measure as long as the turns are small.
    static Vec3d rateAt(double seconds)
    {
        const double h = 1e-4;
        const auto rate = [=](double (*angle)(double)) { return (angle(seconds + h) - angle(seconds - h)) / (2 * h); };
        return Vec3d(-rate(pitchAt), rate(yawAt), rate(rollAt));
    }

    Mat frame(int i) const
    {
        const Matx33d& K = camera.cameraMatrix;
        Mat map(camera.imageSize, CV_32FC2), image;
        for (int y = 0; y < map.rows; y++)
        {
            const double seconds = i * interval() + (y - camera.referenceRow) * camera.lineDelay;
            const Matx33d H = K * rotation(yawAt(seconds), rollAt(seconds), pitchAt(seconds)) * K.inv();
            for (int x = 0; x < map.cols; x++)
            {
                const Vec3d p = H * Vec3d(x, y, 1);
                map.at<Point2f>(y, x) = Point2f(float(p[0] / p[2] + margin), float(p[1] / p[2] + margin));
            }
        }
        remap(scene, image, map, noArray(), INTER_CUBIC, BORDER_REFLECT);
        return image;
    }

private:
    // From the camera to the scene, by the signs of a camera whose z axis points ahead and whose y axis points down.
    static Matx33d rotation(double yaw, double roll, double pitch)
    {
        const Matx33d turned(std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw)),
            rolled(std::cos(roll), -std::sin(roll), 0, std::sin(roll), std::cos(roll), 0, 0, 0, 1),
            pitched(1, 0, 0, 0, std::cos(pitch), std::sin(pitch), 0, -std::sin(pitch), std::cos(pitch));
        return turned * rolled * pitched;
    }

    int margin;
    Mat scene;
};

} // namespace simulation
} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_SHAKING_CAMERA_HPP
