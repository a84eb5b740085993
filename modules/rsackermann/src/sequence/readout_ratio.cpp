// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "frame_terms.hpp"
#include "readout_ratio.hpp"

namespace cv { namespace rsackermann {

// In standard deviations of slants: edges that lean as a read-out would make them.
static const double LEAN_SIGMA = 0.2;
// Of the ratio, by verticals that are nearer or farther than planes.
static const double DISTANCE_SIGMA = 0.1;

ReadoutEvidence measureReadout(const RollingShutterCamera& camera, const std::vector<UprightSegment>& verticals,
                               const std::vector<double>& weights, const SequenceVector& state,
                               const SequenceMatrix& covariance, double about)
{
    typedef Eigen::Matrix<double, PARAMETERS, 1> Gradient;
    struct Slant
    {
        double value, byRatio; // in sigmas
        Gradient byModel;
    };
    const CauchyLoss loss(SLANT_SCALE, 1 / DEPENDENCE);
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const Model values = toModel(state, camera.secondsPerUnitTime(), &byValues);
    const PreparedModel model(values, camera.heading);
    const Matx<double, PARAMETERS, PARAMETERS> ofModel = byValues * covariance * byValues.t();
    const Eigen::Map<const Eigen::Matrix<double, PARAMETERS, PARAMETERS>> P(ofModel.val); // symmetric
    std::vector<Slant> slants(verticals.size());
    for (size_t i = 0; i < verticals.size(); i++)
    {
        Slant& s = slants[i];
        s.value = slantInSigmas(verticals[i], model, camera.cameraMatrix(0, 0), s.byModel.data());
        s.byRatio = 0;
        for (const Parameter rate : {P_ALPHA, P_B, P_D})
            s.byRatio += s.byModel[rate] * values[rate];
    }
    // By how much the model gives way to another ratio depends on the weights, and they on it.
    Gradient yields = Gradient::Zero();
    ReadoutEvidence evidence;
    for (int step = 0; step < 3; step++)
    {
        Gradient mixed = Gradient::Zero();
        evidence = ReadoutEvidence();
        for (size_t i = 0; i < slants.size(); i++)
        {
            const Slant& s = slants[i];
            const double byRatio = s.byRatio - s.byModel.dot(yields), slant = s.value + (about - 1) * byRatio,
                         weight = weights[i] * loss.slope(slant * slant);
            mixed += weight * s.byRatio * s.byModel;
            evidence.weight += weight;
            evidence.information += weight * byRatio * byRatio;
            evidence.weighed += weight * byRatio * (byRatio - s.value);
        }
        yields = P * mixed;
    }
    return evidence;
}

void ReadoutRatio::add(const ReadoutEvidence& frame, double longestNow)
{
    longest += longestNow;
    frames++;
    if (count == 0 || framesOfLast == framesOfPart)
    {
        if (count == MOST_PARTS)
        {
            for (int i = 0; i < MOST_PARTS / 2; i++)
            {
                const ReadoutEvidence later = parts[2 * i + 1];
                parts[i] = parts[2 * i];
                parts[i].add(later);
            }
            count /= 2;
            framesOfPart *= 2;
        }
        parts[count++] = ReadoutEvidence();
        framesOfLast = 0;
    }
    parts[count - 1].add(frame);
    framesOfLast++;
    sum.add(frame);
}

double ReadoutRatio::scatter() const
{
    if (count < MOST_PARTS / 2 || !(sum.information > 0))
        return 0;
    double squares = 0;
    for (int i = 0; i < count; i++)
        squares += std::pow(parts[i].weighed - shown() * parts[i].information, 2);
    // By the variance of Student's distribution, (n - 1) / (n - 3).
    const double byParts = std::sqrt(squares * count / (count - 3)) / sum.information,
                 byLeans = LEAN_SIGMA * std::sqrt(sum.weight / sum.information);
    return std::sqrt(byParts * byParts + byLeans * byLeans + DISTANCE_SIGMA * DISTANCE_SIGMA);
}

bool ReadoutRatio::isPossible() const
{
    return frames == 0 || std::abs(shown()) < longest / frames + CONTRADICTION * scatter();
}

double ReadoutRatio::value() const
{
    return isPossible() ? shown() : 1;
}

double ReadoutRatio::sigma() const
{
    return isPossible() ? scatter() : 0;
}

double ReadoutRatio::error() const
{
    const double difference = std::abs(value() - 1);
    return sigma() > 0 && difference > CONTRADICTION * sigma() ? difference : 0;
}

}} // namespace cv::rsackermann
