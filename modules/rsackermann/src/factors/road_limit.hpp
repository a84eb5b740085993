// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_ROAD_LIMIT_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_ROAD_LIMIT_HPP

#include "../motion/compensation.hpp"

namespace cv { namespace rsackermann {

const double HEIGHT_SIGMA = 0.06; //!< relative, of a given height: a car bounces on its suspension
const double UNUSUAL = 0.1;       //!< probability of what is seldom in a street

/** How far away walls may be, in heights of the camera, for the ends of their segments to be on the road or above it
(doc/theory.md, "Prior").

An end at the ratio r of distance and height is above the road if the wall's distance is at most r heights of the
camera. It counts as a part of an end, since those of one facade err together.
*/
class RoadLimit
{
    struct End
    {
        double logRatio, part; // for how many it counts
    };

    struct Table
    {
        std::vector<double> values; // by the logarithm of the ratio; empty: 1 everywhere
        std::vector<End> ends;

        double at(double logRatio) const;
        void addContacts();
    };

public:
    bool empty() const { return walls[0].values.empty() && walls[1].values.empty(); }

    //! An end of a segment of a wall. @param weight up to 1, of a segment that is one of the wall.
    void add(bool onRightWall, double ratio, double weight);

    //! Ends that agree are those of segments that stand on the road. To be called after the last end.
    void addContacts();

    //! Likelihood of a distance of a motion's left (or only) wall.
    class Likelihood
    {
    public:
        Likelihood(const RoadLimit& limit, const Model& m, const Heading& heading)
            : wall(limit.walls[hasRightWallOnly(m, heading)]), right(m[P_LAMBDA] > 0 ? &limit.walls[1] : nullptr),
              logLambda(right ? std::log(m[P_LAMBDA]) : 0)
        {
        }

        //! @param logRatio logarithm of the distance over the height.
        double operator()(double logRatio) const
        {
            return wall.at(logRatio) * (right ? right->at(logRatio - logLambda) : 1);
        }

    private:
        const Table& wall;  // the left or only one
        const Table* right; // the other one
        const double logLambda;
    };

private:
    Table walls[2]; // left and right
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_ROAD_LIMIT_HPP
