// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SCENE_DEPTH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SCENE_DEPTH_HPP

#include "../distorter.hpp"

namespace cv { namespace rsackermann {

/** Scaled inverse depths of the planes and of the offset of a motion in the pixels of a camera, along its optical axis.

Each plane and the offset are interpolated between the pixels of a coarse grid, on which they are smooth; the nearest
plane is chosen pixel by pixel. */
class SceneDepth
{
public:
    /** @param size of the camera's image.
        @param ofRaw whether it is the raw camera.
        @param matrix camera matrix of the global-shutter camera. */
    SceneDepth(const ShutterGeometry& shutter, const Size& size, bool ofRaw, const Matx33d& matrix);

    //! The values of one row.
    void row(int y, float* depths) const;

private:
    enum { PLANES = Scene::PLANES, STEP = 16, LAYERS = PLANES + 1 }; // the last layer is the offset
    typedef Vec<float, LAYERS> Node;

    void look(const ShutterGeometry& shutter, const Distorter& distorter, const Vec3d& ray, const Point2d& pixel,
              Node& node) const;

    int width;
    bool ofRaw;
    float direction;
    Mat_<Node> nodes;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SCENE_DEPTH_HPP
