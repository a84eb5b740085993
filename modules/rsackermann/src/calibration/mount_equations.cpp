// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "mount_equations.hpp"
#include <Eigen/SparseCholesky>

namespace cv { namespace rsackermann {

double MountEquations::solve(double damping, MountState& step) const
{
    return ReducedMount(*this, damping).solve(step);
}

ReducedMount::ReducedMount(const MountEquations& equations, double damping)
    : information(equations.prior), terms(equations.terms), gradient(equations.priorGradient)
{
    const size_t frames = equations.frames.size();
    const int unknowns = unknownOf(frames, 0);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd linkedGradient = Eigen::VectorXd::Zero(unknowns);
    ByMount mixed = ByMount::Zero(unknowns, int(MOUNT_VALUES));
    information.diagonal() *= 1 + damping;
    for (size_t k = 0; k < frames; k++)
    {
        FrameEquations::Matrix full = equations.frames[k].symmetric();
        full.diagonal() *= 1 + damping;
        typedef Eigen::Matrix<double, SCENE_VALUES, SCENE_VALUES> OfScene;
        const OfScene inverse = scaledInverse<OfScene>(full.topLeftCorner<SCENE_VALUES, SCENE_VALUES>());
        const Eigen::Matrix<double, SCENE_VALUES, 1> own = equations.frames[k].gradient.head<SCENE_VALUES>();
        const Eigen::Matrix<double, SCENE_VALUES, OTHERS> byOthers = full.topRightCorner<SCENE_VALUES, OTHERS>();
        Eigen::Matrix<double, OTHERS, OTHERS> rest = full.bottomRightCorner<OTHERS, OTHERS>();
        Others others = equations.frames[k].gradient.tail<OTHERS>();
        scenes.push_back(Scene(inverse * byOthers, inverse * own, own));
        scenes[k].reduce(byOthers, rest, others);
        gradients.push_back(others);
        const int at = unknownOf(k, 0);
        for (int i = 0; i < LINKED_VALUES; i++)
            for (int j = 0; j < LINKED_VALUES; j++)
                entries.push_back(Eigen::Triplet<double>(at + i, at + j, rest(i, j)));
        linkedGradient.segment<LINKED_VALUES>(at) += others.head<LINKED_VALUES>();
        mixed.block<LINKED_VALUES, SHARED_VALUES>(at, MOUNT_HEADING) +=
            rest.topRightCorner<LINKED_VALUES, SHARED_VALUES>();
        information.bottomRightCorner<SHARED_VALUES, SHARED_VALUES>() +=
            rest.bottomRightCorner<SHARED_VALUES, SHARED_VALUES>();
        gradient.tail<SHARED_VALUES>() += others.tail<SHARED_VALUES>();
    }
    for (size_t t = 0; t < terms.size(); t++)
        for (int i = 0; i < terms[t].count; i++)
        {
            const int a = terms[t].unknown[i];
            (a < 0 ? gradient[~a] : linkedGradient[a]) += terms[t].slope[i] * terms[t].value;
            for (int j = 0; j < terms[t].count; j++)
            {
                const int b = terms[t].unknown[j];
                const double product = terms[t].slope[i] * terms[t].slope[j] * (i == j ? 1 + damping : 1);
                if (a >= 0 && b >= 0)
                    entries.push_back(Eigen::Triplet<double>(a, b, product));
                else if (a >= 0)
                    mixed(a, ~b) += product;
                else if (b < 0)
                    information(~a, ~b) += product;
            }
        }
    Eigen::SparseMatrix<double> ofLinked(unknowns, unknowns);
    ofLinked.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(ofLinked);
    linked =
        SchurComplement<ByMount, Eigen::VectorXd>(solver.solve(mixed), solver.solve(linkedGradient), linkedGradient);
    linked.reduce(mixed, information, gradient);
}

double ReducedMount::solve(MountState& step) const
{
    step.mount = -gradient;
    solveDamped(information, 0, step.mount);
    double gain = linked.gain - step.mount.dot(gradient);
    const Eigen::VectorXd change = linked.substitute(step.mount);
    step.frames.resize(scenes.size());
    for (size_t k = 0; k < scenes.size(); k++)
    {
        Others others;
        others << change.segment<LINKED_VALUES>(unknownOf(k, 0)), step.mount.tail<SHARED_VALUES>();
        step.frames[k] << scenes[k].substitute(others), others.head<LINKED_VALUES>();
        gain += scenes[k].gain;
    }
    return gain;
}

std::vector<MountVector> ReducedMount::scores() const
{
    std::vector<MountVector> result;
    for (size_t k = 0; k < scenes.size(); k++)
    {
        result.push_back(-linked.byOthers.middleRows<LINKED_VALUES>(unknownOf(k, 0)).transpose() *
                         gradients[k].head<LINKED_VALUES>());
        result[k].tail<SHARED_VALUES>() += gradients[k].tail<SHARED_VALUES>();
    }
    for (size_t t = 0; t < terms.size(); t++)
        for (int i = 0; i < terms[t].count; i++)
        {
            const int a = terms[t].unknown[i];
            MountVector& score = result[terms[t].frame];
            const double along = terms[t].slope[i] * terms[t].value;
            if (a < 0)
                score[~a] += along;
            else
                score -= along * linked.byOthers.row(a).transpose();
        }
    return result;
}

}} // namespace cv::rsackermann
