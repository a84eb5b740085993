// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "exports.hpp"
#include "output/image_file.hpp"
#include "output/atomic_file.hpp"
#include "opencv2/rsackermann/warp.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

std::string colmapCameras(const RollingShutterCamera& camera)
{
    const cv::Matx33d& K = camera.cameraMatrix;
    // The centre of COLMAP's first pixel is at (0.5, 0.5).
    return cv::format("# Camera list with one line of data per camera:\n"
                      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
                      "# Number of cameras: 1\n"
                      "1 PINHOLE %d %d %.17g %.17g %.17g %.17g\n",
                      camera.imageSize.width, camera.imageSize.height, K(0, 0), K(1, 1), K(0, 2) + 0.5, K(1, 2) + 0.5);
}

std::string colmapMask(const std::string& folder, const MotionFrame& frame)
{
    return folder + "/masks/" + frame.name() + ".png";
}

void writeColmap(const std::string& folder, const RollingShutterCamera& camera, const std::vector<MotionFrame>& frames)
{
    writeFile(folder + "/cameras.txt", colmapCameras(camera));
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (const MotionFrame& frame : frames)
    {
        cv::Mat columns, rows, mask;
        generator->setCamera(frame.cameraOf(camera));
        generator->initRectifyMap(frame.motion, columns, rows, CV_32FC1, mask);
        writeImage(colmapMask(folder, frame), mask);
    }
}

} // namespace rsackermann_samples
