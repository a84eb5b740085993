// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_FACTORS_PREPARED_MODEL_HPP
#define OPENCV_RSACKERMANN_SRC_FACTORS_PREPARED_MODEL_HPP

#include "../motion/compensation.hpp"
#include "../motion/model.hpp"

namespace cv { namespace rsackermann {

//! A model with the parts of its residuals that all segments share.
struct PreparedModel
{
    double alpha, B, D, lambda, direction;
    double G, GbyB, GbyD; // the road's factor and its derivatives
    Heading heading;
    double cosRoll, sinRoll, cosPitch, sinPitch;
    double streetX, streetZ; // direction of the street in the horizontal plane
    bool translates;         // whether B and D say where the street goes; otherwise P_STREET does

    //! @param roadRatio distance of the left (or only) wall over the height of the camera; 0: without a road.
    PreparedModel(const Model& m, const Heading& heading_, double roadRatio = 0, bool translates_ = true)
        : alpha(m[P_ALPHA]), B(m[P_B]), D(m[P_D]), lambda(m[P_LAMBDA]), direction(m.direction), heading(heading_),
          cosRoll(std::cos(m[P_ROLL])), sinRoll(std::sin(m[P_ROLL])), cosPitch(std::cos(m[P_PITCH])),
          sinPitch(std::sin(m[P_PITCH])), streetX(translates_ ? D : std::sin(m[P_STREET])),
          streetZ(translates_ ? B : std::cos(m[P_STREET])), translates(translates_)
    {
        const double size = std::sqrt(B * B + D * D), road = direction * roadRatio;
        G = road * size;
        GbyB = size > 0 ? road * B / size : 0;
        GbyD = size > 0 ? road * D / size : 0;
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_FACTORS_PREPARED_MODEL_HPP
