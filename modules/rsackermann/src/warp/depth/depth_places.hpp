// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_PLACES_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_PLACES_HPP

#include "../distorter.hpp"
#include "../rectifier.hpp"

namespace cv { namespace rsackermann {

/** The place in the other image of what a pixel of a map shows, as a function of its depth, in double precision.

The depth is given by its inverse in 1/m along the optical axis, either of the pixel's own camera or of the other one
(doc/theory.md, "Warp").
*/
class DepthPlaces
{
public:
    //! What the search for one place leaves for the next one, of the same pixel or one nearby.
    struct Guess
    {
        Rectifier::Guess row;
        bool hasView = false;
        Point2d pixel; // of the view
        Distorter::View view;
    };

    /** @param way metres per unit of row time.
    @param ofRaw whether the depths are those of the raw camera at each row's instant. */
    DepthPlaces(const ShutterGeometry& shutter_, double way_, bool ofRaw_) : shutter(shutter_), way(way_), ofRaw(ofRaw_)
    {
    }
    virtual ~DepthPlaces() {}

    //! False if there is no place, or one that cv::remap can't address. @param guess read and written.
    virtual bool find(const Point2d& pixel, double inverseDepth, Point2d& place, Guess& guess) const = 0;

    bool find(const Point2d& pixel, double inverseDepth, Point2d& place) const
    {
        Guess none;
        return find(pixel, inverseDepth, place, none);
    }

    //! Whether rows turn by a curve that has knots.
    virtual bool hasKnots() const { return shutter.hasCurve(); }
    //! Whether there are so few of them between two pixels with their places that the checks of a patch notice them.
    virtual bool isSmoothBetween(const Point2d& pixel, const Point2d& place, const Point2d& otherPixel,
                                 const Point2d& otherPlace) const
    {
        return shutter.isSmoothBetween(rowTime(pixel, place), rowTime(otherPixel, otherPlace));
    }

protected:
    //! That of whichever is in the raw image.
    virtual double rowTime(const Point2d& pixel, const Point2d& place) const = 0;

    const ShutterGeometry& shutter;
    const double way;
    const bool ofRaw;
};

//! Of the pixels of a rectify map: places in the raw image.
class RectifyPlaces CV_FINAL : public DepthPlaces
{
public:
    //! @param matrix camera matrix of the global-shutter camera.
    RectifyPlaces(const ShutterGeometry& shutter, const Matx33d& matrix, double way, bool ofRaw, int maxIterations,
                  double tolerance);

    using DepthPlaces::find;
    bool find(const Point2d& pixel, double inverseDepth, Point2d& place, Guess& guess) const CV_OVERRIDE;

private:
    double rowTime(const Point2d&, const Point2d& place) const CV_OVERRIDE { return shutter.rowTime(place); }
    double depthInRow(const Vec3d& b, const RowMotion& m, double t) const;

    Rectifier rectifier;
    Matx33d inverse; // pixel of the global-shutter camera to ray
};

//! Of the pixels of a distort map: places in the image of the global-shutter camera.
class DistortPlaces CV_FINAL : public DepthPlaces
{
public:
    //! @param matrix camera matrix of the global-shutter camera.
    DistortPlaces(const ShutterGeometry& shutter, const Matx33d& matrix, double way, bool ofRaw);

    using DepthPlaces::find;
    bool find(const Point2d& pixel, double inverseDepth, Point2d& place, Guess& guess) const CV_OVERRIDE;

private:
    double rowTime(const Point2d& pixel, const Point2d&) const CV_OVERRIDE { return shutter.rowTime(pixel); }

    Distorter distorter;
    Matx33d matrix;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_DEPTH_PLACES_HPP
