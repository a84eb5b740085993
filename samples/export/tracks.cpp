// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include "opencv2/rsackermann/warp.hpp"
#include "point_table.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

std::string correctTracks(const std::string& path, const RollingShutterCamera& camera,
                          const std::vector<MotionFrame>& frames)
{
    PointTable table(path, {"x", "y"}, frames);
    const size_t x = table.column("x"), y = table.column("y"), depth = table.column("depth");
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (size_t i = 0; i < frames.size(); i++)
    {
        std::vector<cv::Point2d> points;
        std::vector<double> depths;
        for (const size_t row : table.rowsOf(i))
        {
            points.push_back(cv::Point2d(table.numberThere(row, x), table.numberThere(row, y)));
            depths.push_back(table.number(row, depth));
        }
        if (points.empty())
            continue;
        generator->setCamera(frames[i].cameraOf(camera));
        const bool depthsKnown = cv::countNonZero(depths) > 0;
        if (depthsKnown)
            frames[i].checkMetres();
        cv::Mat places, mask;
        generator->correctPoints(frames[i].motion, points, places, depthsKnown ? cv::Mat(depths) : cv::Mat(), mask);
        for (size_t k = 0; k < points.size(); k++)
        {
            const cv::Vec2d place = places.at<cv::Vec2d>(int(k));
            const bool found = mask.at<uchar>(int(k)) != 0;
            table.set(table.rowsOf(i)[k], x, found ? cv::format("%.6f", place[0]) : "");
            table.set(table.rowsOf(i)[k], y, found ? cv::format("%.6f", place[1]) : "");
        }
    }
    return table.text();
}

} // namespace rsackermann_samples
