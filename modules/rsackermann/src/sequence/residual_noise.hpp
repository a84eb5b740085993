// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_RESIDUAL_NOISE_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_RESIDUAL_NOISE_HPP

#include "../optim/median.hpp"
#include "frame_fit.hpp"

namespace cv { namespace rsackermann {

// How much residuals really err, from their medians; doc/theory.md, "Self-calibration".

//! 1/m by which the inverse depth of a part of the scene differs from that of its plane: a metre or two of ten
const double DEVIATION_SIGMA = 0.03;
//! Of the points of one frame, over POINT_SIGMA: tracking errs alike where images look alike, however many they are
const double LEAST_NOISE = 0.2;
//! Pixels; of the tracker where there is texture, at most: along edges it errs by TrackedBearing::weak as much
const double TRACKING_SIGMA = 0.1;

//! An absolute residual, and by what something changes it whose scale is to be found, as a usual deviation of the
//! depth.
struct UncertainResidual
{
    double value, by;
};

//! Standard deviations of the residuals of points and of depths, over POINT_SIGMA and DEVIATION_SIGMA.
struct PointNoise
{
    double points, depths;

    /** The inverse square root of a point's covariance.
    @param weak of its TrackedBearing.
    @param d pixels by which a usual deviation of the depth moves it. */
    Matx22d weight(const Point2d& weak, const Point2d& d) const;
};

//! Residuals of points, across and along their epipolar lines.
struct PointResiduals
{
    std::vector<UncertainResidual> across; // by texture
    std::vector<UncertainResidual> along;  // by depth
    std::vector<double> weakAlong;         // by texture

    void add(const Point2d& residual, const Point2d& weak, const Point2d& d);

    //! What explains them. @param least standard deviation of points, over the usual one.
    PointNoise noise(double least) const;
};

/** Pixels by which a point is elsewhere in the other image if it is nearer than its plane by a usual deviation.
@param unit seconds per unit of row time. */
Point2d pixelsOfDeviation(const FlowResidual& residual, const TrackedBearing& point, const FlowResidual::Values& values,
                          double unit, const FlowResidual::View& view);

/** What the points of a frame show of their noise.
@param weak of each.
@param residuals pixels, which don't count if the point would be behind the camera.
@param d of each, pixels by which a usual deviation of the depth moves it. */
PointNoise noiseOf(const std::vector<Point2d>& weak, const std::vector<Point2d>& residuals,
                   const std::vector<Point2d>& d);

//! PointNoise::weight() of each.
std::vector<Matx22d> weightsOf(const PointNoise& noise, const std::vector<Point2d>& weak,
                               const std::vector<Point2d>& d);

/** The value up to 1 with which residuals have the median of a normal distribution of the standard deviations
sigmaOf(value, by), which grow with it. */
template <class SigmaOf>
double solveScale(const std::vector<UncertainResidual>& residuals, const SigmaOf& sigmaOf)
{
    const int halvings = 10;
    double low = 0, high = 1;
    std::vector<double> values(residuals.size());
    for (int i = 0; i < halvings && !residuals.empty(); i++)
    {
        const double middle = (low + high) / 2;
        for (size_t k = 0; k < residuals.size(); k++)
            values[k] = residuals[k].value / sigmaOf(middle, residuals[k].by);
        (sigmaOfMedian(medianOf(values.begin(), values.end())) > 1 ? low : high) = middle;
    }
    return high;
}

//! Of the image's longer side: how far points are from each other that may be of one house.
const double NEIGHBOURHOOD = 0.2;

//! How much points that are next to each other deviate alike, as those of one house do that stands back.
class Neighbours
{
public:
    //! @param reach_ in the unit of places.
    explicit Neighbours(double reach_) : reach(reach_) {}

    //! @param residual in sigmas; without outliers. @param d pixelsOfDeviation(), whose direction counts.
    void add(const Point2d& place, const Vec2d& residual, const Point2d& d);

    /** Points that count as one: #DEPENDENCE, as the same ones are seen again and again, times the variance of the sum
    of neighbours' deviations over that of independent ones, if that is more. What neighbours deviate alike across d is
    of the camera's turns, and counts on neither side. */
    double dependence() const;

private:
    const double reach;
    std::vector<Point2d> places;
    std::vector<double> along, across; // the direction of deviations
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_RESIDUAL_NOISE_HPP
