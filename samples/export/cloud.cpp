// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include "opencv2/rsackermann/warp.hpp"
#include "options.hpp"
#include "point_table.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

static bool isInside(const cv::Vec2d& place, const cv::Size& size)
{
    return place[0] >= -0.5 && place[1] >= -0.5 && place[0] <= size.width - 0.5 && place[1] <= size.height - 0.5;
}

std::string cloudInRawImages(const std::string& path, const RollingShutterCamera& camera,
                             const std::vector<MotionFrame>& frames)
{
    PointTable table(path, {"x", "y", "z"}, frames);
    const size_t x = table.column("x"), y = table.column("y"), z = table.column("z");
    const size_t u = table.addColumn("u"), v = table.addColumn("v");
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const cv::Matx33d K = camera.cameraMatrix; // of the global-shutter camera as well
    for (size_t i = 0; i < frames.size(); i++)
    {
        std::vector<cv::Point2d> pixels; // of the global-shutter camera
        std::vector<double> depths;
        std::vector<size_t> rows;
        for (const size_t row : table.rowsOf(i))
        {
            const cv::Vec3d point(table.numberThere(row, x), table.numberThere(row, y), table.numberThere(row, z));
            if (!(point[2] > 0))
                continue;
            const cv::Vec3d pixel = K * point / point[2];
            pixels.push_back(cv::Point2d(pixel[0], pixel[1]));
            depths.push_back(point[2]);
            rows.push_back(row);
        }
        if (rows.empty())
            continue;
        frames[i].checkMetres();
        generator->setCamera(frames[i].cameraOf(camera));
        cv::Mat places, mask;
        try
        {
            generator->distortPoints(frames[i].motion, pixels, places, depths, mask);
        }
        catch (const cv::Exception& e)
        {
            throw InputError(frames[i].name() + ": " + e.err);
        }
        for (size_t k = 0; k < rows.size(); k++)
        {
            const cv::Vec2d place = places.at<cv::Vec2d>(int(k));
            if (mask.at<uchar>(int(k)) == 0 || !isInside(place, camera.imageSize))
                continue;
            table.set(rows[k], u, cv::format("%.6f", place[0]));
            table.set(rows[k], v, cv::format("%.6f", place[1]));
        }
    }
    return table.text();
}

} // namespace rsackermann_samples
