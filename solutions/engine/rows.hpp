#pragma once
// From contacts to rows: one row a frictionless contact.
//
//   dg/dt = G W          G of the contact, Eq. (3.3); of a point mass the linear part of it
//   a, b, Σ              from h, k, d, Eq. (3.4)-(3.6)
//   0 <= λ < ∞           a contact pushes, never pulls
//   S_kk, B              Eq. (4.3), (4.4)
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
Constraint<Dof> contact_constraint(const Contact& contact, const Spook& spook);

/// Replaces `rows` with one for each contact, in the same order.
template <int Dof>
void build_contact_rows(const std::vector<Contact>& contacts, const Spook& spook, const Motion<Dof>& motion,
                        std::vector<Row<Dof>>& rows);

}  // namespace spook
