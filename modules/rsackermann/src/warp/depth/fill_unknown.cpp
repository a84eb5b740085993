// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../parallel_loop.hpp"
#include "../distorter.hpp"
#include "inverse_depth_image.hpp"
#include "opencv2/imgproc.hpp"

namespace cv { namespace rsackermann {

namespace {

/* Scaled inverse depths of the planes and of the offset of a motion in the pixels of a camera, along its optical axis.
Each plane and the offset are interpolated between the pixels of a coarse grid, on which they are smooth; the nearest
plane is chosen pixel by pixel. */
class SceneDepth
{
public:
    SceneDepth(const ShutterGeometry& shutter, const Size& size, bool ofRaw_, const Matx33d& matrix)
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

    // The values of one row.
    void row(int y, float* depths) const
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

private:
    enum { PLANES = Scene::PLANES, STEP = 16, LAYERS = PLANES + 1 }; // the last layer is the offset
    typedef Vec<float, LAYERS> Node;

    // Pixels without a ray, or at whose instant the camera would have passed a wall, are infinitely far away.
    void look(const ShutterGeometry& shutter, const Distorter& distorter, const Vec3d& ray, const Point2d& pixel,
              Node& node) const
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

    int width;
    bool ofRaw;
    float direction;
    Mat_<Node> nodes;
};

// Each level has half of the size of the one before; beyond the last one nothing is known.
const int LEVELS = 7;

// Means over squares of 2 x 2 of the values that aren't NaN; NaN where there is none.
void halve(const Mat1f& fine, Mat1f& coarse)
{
    coarse.create((fine.rows + 1) / 2, (fine.cols + 1) / 2);
    forEachInParallel(coarse.rows, [&](int y) {
        for (int x = 0; x < coarse.cols; x++)
        {
            float sum = 0;
            int count = 0;
            for (int k = 0; k < 4; k++)
            {
                const int row = 2 * y + k / 2, column = 2 * x + k % 2;
                const float value = row < fine.rows && column < fine.cols ? fine(row, column) : NAN;
                if (!cvIsNaN(value))
                {
                    sum += value;
                    count++;
                }
            }
            coarse(y, x) = count > 0 ? sum / count : NAN;
        }
    });
}

// The unknown values of a level from the next one, all of whose values are known.
void fillFrom(const Mat1f& coarse, Mat1f& fine)
{
    Mat1f doubled;
    resize(coarse, doubled, Size(2 * coarse.cols, 2 * coarse.rows), 0, 0, INTER_LINEAR);
    forEachInParallel(fine.rows, [&](int y) {
        float* values = fine[y];
        const float* others = doubled[y];
        for (int x = 0; x < fine.cols; x++)
            values[x] = cvIsNaN(values[x]) ? others[x] : values[x];
    });
}

} // namespace

void fillUnknown(const ShutterGeometry& shutter, bool ofRaw, const Matx33d& matrix, double scale_, Mat1f& image)
{
    const SceneDepth scene(shutter, image.size(), ofRaw, matrix);
    const float scale = float(scale_);
    Mat1f levels[LEVELS], fromScene(image.size());
    levels[0].create(image.size());
    forEachInParallel(image.rows, [&](int y) {
        scene.row(y, fromScene[y]);
        for (int x = 0; x < image.cols; x++)
        {
            fromScene(y, x) *= scale;
            levels[0](y, x) = image(y, x) - fromScene(y, x);
        }
    });
    for (int i = 1; i < LEVELS; i++)
        halve(levels[i - 1], levels[i]);
    patchNaNs(levels[LEVELS - 1], 0);
    for (int i = LEVELS - 1; i > 0; i--)
        fillFrom(levels[i], levels[i - 1]);
    forEachInParallel(image.rows, [&](int y) {
        for (int x = 0; x < image.cols; x++)
            if (cvIsNaN(image(y, x)))
                image(y, x) = fromScene(y, x) + levels[0](y, x);
    });
}

}} // namespace cv::rsackermann
