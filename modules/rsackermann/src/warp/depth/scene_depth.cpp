// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "scene_depth.hpp"

namespace cv { namespace rsackermann {

SceneDepth::SceneDepth(const ShutterGeometry& shutter, const Size& size, bool ofRaw_, const Matx33d& matrix)
    : width(size.width), ofRaw(ofRaw_), direction(float(shutter.scene.direction)),
      nodes((size.height - 1) / STEP + 2, (size.width - 1) / STEP + 2)
{
    const Distorter distorter(shutter);
    const Matx33d inverse = matrix.inv();
    for (int i = 0; i < nodes.rows; i++)
        for (int j = 0; j < nodes.cols; j++)
        {
            const Point2d pixel(j * STEP, i * STEP);
            look(shutter, distorter, inverse * Vec3d(pixel.x, pixel.y, 1), pixel, nodes(i, j));
        }
}

// Pixels without a ray, or at whose instant the camera would have passed a wall, are infinitely far away.
void SceneDepth::look(const ShutterGeometry& shutter, const Distorter& distorter, const Vec3d& ray,
                      const Point2d& pixel, Node& node) const
{
    Distorter::View view = {shutter.up * ray, 0, 0};
    node = Node::all(0);
    if (ofRaw && !distorter.view(pixel, view))
        return;
    double planes[PLANES], nearest;
    shutter.scene.inverseDepths(view.direction, view.x, view.z, planes);
    for (int k = 0; k < PLANES; k++)
        node[k] = direction * float(planes[k]);
    if (!shutter.depthOffset.empty() && distorter.findInverseDepth(view, nearest))
        node[PLANES] = float(nearest - shutter.scene.inverseDepth(view.direction, view.x, view.z));
}

void SceneDepth::row(int y, float* depths) const
{
    const float down = float(y % STEP) / STEP;
    const Node *above = nodes[y / STEP], *below = nodes[y / STEP + 1];
    for (int j = 0; j * STEP < width; j++)
    {
        const Node first = above[j] * (1 - down) + below[j] * down,
                   perColumn = (above[j + 1] * (1 - down) + below[j + 1] * down - first) * (1.f / STEP);
        const int count = std::min(int(STEP), width - j * STEP);
        for (int i = 0; i < count; i++)
        {
            float nearest = first[0] + perColumn[0] * i;
            for (int k = 1; k < PLANES; k++)
                nearest = std::max(nearest, first[k] + perColumn[k] * i);
            depths[j * STEP + i] = direction * nearest + first[PLANES] + perColumn[PLANES] * i;
        }
    }
}

}} // namespace cv::rsackermann
