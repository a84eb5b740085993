// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "setting.hpp"

namespace paper {

street::StreetCamera paperCamera(double readOut, int width)
{
    const int height = cvRound(width * 360 / 520.);
    return street::StreetCamera(cv::Size(width, height), 816 * width / 640., readOut / height, 1.2);
}

street::StreetScene paperScene(double speed, double yawRate, unsigned seed)
{
    street::StreetScene scene;
    scene.speed = speed * KMH;
    scene.yawRate = yawRate * DEGREE;
    scene.left = 2.5;
    scene.right = 3;
    scene.seed = seed;
    return scene;
}

cv::Mat verticalLines(const street::StreetRenderer& renderer, const street::StreetCamera& camera, int count,
                      double noise, double outliers, cv::RNG& rng, std::vector<int>& walls)
{
    // Above the horizon there are only walls, and vertical lines of an upright camera are columns.
    const double minLength = 0.1 * camera.size.height, horizon = camera.cy, slope = 0.25;
    cv::Mat lines(0, 4, CV_64F);
    walls.clear();
    for (int tries = 0; lines.rows < count && tries < 20 * count; tries++)
    {
        const double x = rng.uniform(0., camera.size.width - 1.), length = rng.uniform(minLength, horizon);
        const double top = rng.uniform(0., horizon - length);
        const double lean = rng.uniform(0., 1.) < outliers ? rng.uniform(-slope, slope) * length : 0;
        cv::Point2d u, v;
        if (!renderer.toRolling(cv::Point2d(x, top), u) || !renderer.toRolling(cv::Point2d(x, top + length), v))
            continue;
        cv::Vec4d ends(u.x + lean, u.y, v.x, v.y);
        for (int i = 0; i < 4; i++)
            ends[i] += rng.gaussian(noise);
        lines.push_back(cv::Mat(ends.t()));
        walls.push_back(x < camera.cx ? -1 : 1);
    }
    return lines;
}

} // namespace paper
