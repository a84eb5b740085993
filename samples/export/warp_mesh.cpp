// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include "opencv2/rsackermann/warp.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

// The mesh's place of a pixel; false if one of the four nodes around has none.
bool interpolate(const WarpMesh& mesh, const cv::Size& size, const cv::Point2d& pixel, cv::Point2d& place)
{
    // An image that is one pixel wide has all nodes of a row at the same place.
    const double column = pixel.x * (mesh.columns - 1) / std::max(size.width - 1, 1),
                 row = pixel.y * (mesh.rows - 1) / std::max(size.height - 1, 1);
    const int i = std::min(int(column), mesh.columns - 2), j = std::min(int(row), mesh.rows - 2),
              at = j * mesh.columns + i;
    const int corners[] = {at, at + 1, at + mesh.columns, at + mesh.columns + 1};
    const double u = column - i, v = row - j, weights[] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    place = cv::Point2d();
    for (int k = 0; k < 4; k++)
    {
        if (!mesh.found[corners[k]])
            return false;
        place += weights[k] * mesh.places[corners[k]];
    }
    return true;
}

void measureError(const RollingShutterCamera& camera, const cv::Mat& mapColumns, const cv::Mat& mapRows,
                  const cv::Mat& mask, WarpMesh& mesh)
{
    double sum = 0, largest = 0;
    int count = 0;
    for (int y = 0; y < mask.rows; y++)
        for (int x = 0; x < mask.cols; x++)
        {
            cv::Point2d place;
            if (!mask.at<uchar>(y, x) || !interpolate(mesh, camera.imageSize, cv::Point2d(x, y), place))
                continue;
            const double error = std::hypot(place.x - mapColumns.at<float>(y, x), place.y - mapRows.at<float>(y, x));
            largest = std::max(largest, error);
            sum += error * error;
            count++;
        }
    mesh.maxError = largest;
    mesh.rmsError = count ? std::sqrt(sum / count) : 0;
}

} // namespace

WarpMesh makeWarpMesh(const RollingShutterCamera& camera, const AckermannMotion& motion, int columns, int rows)
{
    WarpMesh mesh;
    mesh.columns = columns;
    mesh.rows = rows;
    const cv::Size size = camera.imageSize;
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++)
            mesh.nodes.push_back(
                cv::Point2d(double(size.width - 1) * i / (columns - 1), double(size.height - 1) * j / (rows - 1)));
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    cv::Mat mask;
    generator->distortPoints(motion, mesh.nodes, mesh.places, cv::noArray(), mask);
    mesh.found.assign(mask.begin<uchar>(), mask.end<uchar>());
    cv::Mat mapColumns, mapRows, seen;
    generator->initRectifyMap(motion, mapColumns, mapRows, CV_32FC1, seen);
    measureError(camera, mapColumns, mapRows, seen, mesh);
    return mesh;
}

std::string warpMeshText(const RollingShutterCamera& camera, const std::vector<MotionFrame>& frames, int columns,
                         int rows)
{
    typedef nlohmann::ordered_json Json;
    Json json;
    json["width"] = camera.imageSize.width;
    json["height"] = camera.imageSize.height;
    json["columns"] = columns;
    json["rows"] = rows;
    json["frames"] = Json::array();
    const std::vector<std::string> names = namesInTables(frames);
    for (size_t i = 0; i < frames.size(); i++)
    {
        const MotionFrame& f = frames[i];
        const WarpMesh mesh = makeWarpMesh(f.cameraOf(camera), f.motion, columns, rows);
        Json frame, nodes = Json::array();
        for (size_t k = 0; k < mesh.nodes.size(); k++)
            nodes.push_back(mesh.found[k] ? Json({mesh.nodes[k].x, mesh.nodes[k].y, mesh.places[k].x, mesh.places[k].y})
                                          : Json({mesh.nodes[k].x, mesh.nodes[k].y, nullptr, nullptr}));
        frame["file"] = names[i];
        frame["max_error_px"] = mesh.maxError;
        frame["rms_error_px"] = mesh.rmsError;
        frame["nodes"] = nodes;
        json["frames"].push_back(frame);
    }
    // A file's name needn't be valid UTF-8.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace rsackermann_samples
