// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SINGLE_MOTION_SAMPLES_HPP
#define OPENCV_RSACKERMANN_SRC_SINGLE_MOTION_SAMPLES_HPP

#include "displacement_field.hpp"
#include "../factors/driving_prior.hpp"

namespace cv { namespace rsackermann {

//! A motion and the slope of the road's scaled inverse depth.
struct Correction
{
    Model model;
    double G;

    Correction() : G(0) {}
    Correction(const Model& model_, double G_) : model(model_), G(G_) {}

    //! The same motion, slower or faster.
    Correction scaled(double factor) const;
};

/** Motions with weights, and their displacement fields: what a decision is made over (doc/theory.md, "Posterior"). */
class MotionSamples
{
public:
    MotionSamples(const DisplacementField& field_, const DrivingPrior& prior_, const RoadContact& contact_)
        : field(field_), prior(prior_), contact(contact_)
    {
    }

    /** Adds the sigma points of a motion with uncertain walls and road: two for each unknown.
    @param covariance of the model's B, D and lambda. */
    void add(const Model& model, const Matx<double, PARAMETERS, PARAMETERS>& covariance, double weight);

    //! The middle of the motions but rest: the mean, in which few that are far away hardly count.
    Correction middleOfMoving() const;

    struct Expectation
    {
        double raw, residual;    //!< mean displacements before and after the correction, pixels
        double harm;             //!< E[max(0, residual - raw)]
        double probabilityWorse; //!< that the residual is larger than the raw displacement
    };

    //! What becomes of the image by a correction.
    Expectation expect(const Correction& correction) const;

private:
    // Horizontal, then vertical displacements of a field, in single precision and padded: distances between thousands
    // of them are needed.
    enum { PADDED = (DisplacementField::POINTS + 7) / 8 * 8, SIZE = 2 * PADDED };

    void addSample(const Model& model, double G, double weight);
    void fieldOf(const Correction& correction, float* values) const;
    Correction mean(const std::vector<double>& share) const;

    const DisplacementField& field;
    const DrivingPrior& prior;
    const RoadContact contact;
    std::vector<Correction> motions;
    std::vector<double> weights; // their sum is 1
    std::vector<float> fields;
    std::vector<double> raw; // mean displacements
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SINGLE_MOTION_SAMPLES_HPP
