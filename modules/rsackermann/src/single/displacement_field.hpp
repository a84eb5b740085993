// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_DISPLACEMENT_FIELD_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_DISPLACEMENT_FIELD_HPP

#include "opencv2/rsackermann/camera.hpp"
#include "../motion/model.hpp"
#include "../motion/row_tilt.hpp"

namespace cv { namespace rsackermann {

/** By how much a motion displaces the pixels of an image, to first order, at the points of a grid (doc/theory.md,
"Posterior").

Displacements of several motions can be averaged and compared, which their parameters can't. Each point counts by what
the image shows next to it: an empty road, however near, isn't seen to move.
*/
class DisplacementField
{
public:
    enum { COLUMNS = 9, ROWS = 6, POINTS = COLUMNS * ROWS };
    typedef Vec<double, 2 * POINTS> Values; //!< pixels: horizontal, vertical for each point
    typedef Vec<double, POINTS> Variances;  //!< square pixels

    //! A place of the image, and how the image moves there.
    struct Point
    {
        Point2d pixel;
        double x, y, z;      //!< upright bearing x, y, 1 of a ray that has the depth z per depth along the optical axis
        double time, weight; //!< row time; 1 in the mean
        double t;            //!< product of both
        //! Derivative of the pixel by x and y: a camera that is tilted, or a lens, shows them shorter or longer
        Matx22d toPixels;

        //! Displacement by alpha, of a point at infinity.
        Vec2d byAlpha() const { return toPixels * Vec2d(2 * (1 + x * x), 2 * x * y) * t; }
        //! The same by the point's scaled inverse depth. @param sine, cosine of the heading.
        Vec2d byInverseDepth(double sine, double cosine) const
        {
            return toPixels * Vec2d(sine - x * cosine, -y * cosine) * t;
        }
    };

    //! @param seen upright bearings, with z = 1, of what the image shows; without any, all points count alike.
    explicit DisplacementField(const RollingShutterCamera& camera,
                               const std::vector<Point2d>& seen = std::vector<Point2d>());

    const Point& point(int k) const { return points[k]; }

    //! Times the weight of the point. @param G slope of the road's scaled inverse depth.
    void displacement(const Model& model, double G, Values& values) const;

    //! Adds what rows contribute that are tilted.
    void addTilt(const RowTilt& tilt, Values& values) const;
    //! The same of the standard deviations of how much they pitch and roll per unit of row time.
    void addTiltVariance(double pitchRateSigma, double rollRateSigma, Variances& values) const;

    //! Mean length over the points of the difference of two displacements, if one of them has the given variance.
    static double meanDistance(const Values& a, const Values& b, const Variances& variance);

    /** Probability that a correction makes it worse: by an error of more than half of it, in the opposite direction.
    @param corrected mean displacement that is taken off. @param residual mean distance that is expected to be left. */
    static double probabilityWorse(double corrected, double residual);

    //! Variance of the displacement at each point, for a covariance of the parameters, and of G independent of it.
    void variance(const Model& model, double G, double varianceG,
                  const Matx<double, PARAMETERS, PARAMETERS>& covariance, Variances& values) const;

    //! The MotionModel of a motion without the parts that contribute next to nothing to the displacement.
    int mainMotion(const Model& model, double G) const;

private:
    void weigh(const std::vector<Point2d>& seen);
    Point2d byTurn(const Point& point, const Vec3d& turn) const;

    Point points[POINTS];
    double headingSine, headingCosine;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_DISPLACEMENT_FIELD_HPP
