// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_INVERSE_DEPTH_IMAGE_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_INVERSE_DEPTH_IMAGE_HPP

#include "opencv2/rsackermann/depth_map.hpp"
#include "../shutter_geometry.hpp"
#include "depth_ranges.hpp"
#include <atomic>

namespace cv { namespace rsackermann {

//! Inverse depth in 1/m of the pixels of a camera.
class InverseDepths
{
public:
    virtual ~InverseDepths() {}

    //! Those of a rectangle, with their range, which is never too narrow; empty if some aren't known.
    virtual Mat1f part(const Rect& area, float& low, float& high) const = 0;
};

//! The given ones. They are read when they are needed: one pixel's own depth is needed once.
class GivenDepths CV_FINAL : public InverseDepths
{
public:
    /** @param depth checked, not empty.
        @param nearest least depth in metres that counts as known. */
    GivenDepths(const DepthMap& depth_, double nearest_) : depth(depth_), nearest(nearest_), isComplete(true) {}

    Mat1f part(const Rect& area, float& low, float& high) const CV_OVERRIDE;

    //! Whether everything that was asked for is known.
    bool areComplete() const { return isComplete; }

    //! Some pixels of a row; NaN: unknown. Returns whether all are known.
    bool read(const Point& first, int width, float* inverse) const;

private:
    const DepthMap& depth;
    double nearest;
    mutable std::atomic<bool> isComplete;
};

//! Those of all pixels: the given ones, and the scene's where none is known.
class InverseDepthImage CV_FINAL : public InverseDepths
{
public:
    /** @param depth checked, not empty.
        @param way metres per unit of row time, not 0.
        @param nearest least depth in metres that counts as known. */
    InverseDepthImage(const DepthMap& depth, const ShutterGeometry& shutter, const Matx33d& matrix, double way,
                      double nearest);

    Mat1f part(const Rect& area, float& low, float& high) const CV_OVERRIDE;

    const Mat1f& values() const { return image; }

    //! Whether there are four pixels around each place, between which vectors search.
    bool hasCells() const { return image.rows > 1 && image.cols > 1; }

    //! Of the values in a rectangle.
    DepthRange range(const Rect& area) const { return ranges.of(area); }
    //! Of all values.
    const DepthRange& range() const { return ranges.ofAll(); }

    /** The value at a place.

    It is interpolated between four pixels unless they differ by more than gap: then it is that of the nearest one. A
    place outside of the image has the value of its border. */
    float at(float x, float y, float gap) const
    {
        const float px = std::min(std::max(x, 0.f), lastX), py = std::min(std::max(y, 0.f), lastY);
        const int column = int(px), row = int(py);
        const size_t right = column + 1 < image.cols, below = row + 1 < image.rows ? image.step1() : 0;
        const float fx = px - column, fy = py - row;
        const float* p = image.ptr<float>(row) + column;
        const float a = p[0], b = p[right], c = p[below], d = p[below + right];
        if (std::max(std::max(a, b), std::max(c, d)) - std::min(std::min(a, b), std::min(c, d)) > gap)
            return p[(fy < 0.5f ? 0 : below) + (fx < 0.5f ? 0 : right)];
        const float top = a + fx * (b - a), bottom = c + fx * (d - c);
        return top + fy * (bottom - top);
    }

private:
    Mat1f image;
    DepthRanges ranges;
    float lastX, lastY;
};

/** Fills the unknown values of an image of inverse depths with those of the scene, without seams.

What is known around shifts the scene's depths: next to known pixels by as much as they differ from the scene, in the
middle of a hole of some hundred pixels not at all (doc/theory.md, "Warp").
@param ofRaw whether it is that of the raw camera.
@param matrix camera matrix of the global-shutter camera.
@param scale of the scene's values in the image.
@param image read and written; NaN: unknown. */
void fillUnknown(const ShutterGeometry& shutter, bool ofRaw, const Matx33d& matrix, double scale, Mat1f& image);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_INVERSE_DEPTH_IMAGE_HPP
