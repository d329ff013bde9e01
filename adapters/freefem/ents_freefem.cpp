// SPDX-License-Identifier: BSD-3-Clause
// FreeFEM's plugin "ents": types and functions of the language. What they do is in border_contact.cpp.
//
//   load "ents"
//   EntsContact contact(Th, slave, master, "model.json");  // labels of two borders of Th
//   real factor = entsForces(contact, u[], r, I, J, C);    // r += R, triplets of K; factor < 1: cut the step.
//                                                          // dt=...: where friction heats
//   entsAccept(contact);                                   // the increment has converged: its history counts
//   entsReject(contact);                                   // or it is thrown away: back to its begin
#include <ff++.hpp>

#include "border_contact.hpp"

namespace {

using freefem::BorderContact;

/// Mistakes become errors of FreeFEM, which end the script with the message.
template <class Action> auto checked(const Action& action) {
  try {
    return action();
  } catch (const std::exception& error) {
    cerr << "\n  ents: " << error.what() << endl;
    throw ErrorExec(error.what(), 1);
  }
}

/// A variable of the language: FreeFEM makes room for it, then calls init.
struct EntsContact {
  BorderContact* contact;
  void init() { contact = nullptr; }
  void destroy() { delete contact, contact = nullptr; }
};

BorderContact& made(EntsContact* variable) {
  if (variable->contact == nullptr)
    throw std::runtime_error("this EntsContact is empty: give it a mesh, two labels and a model");
  return *variable->contact;
}

/// A border's edges, from left to right for one who looks out of the body: that is how segments have to run.
freefem::Border border(const Fem2D::Mesh& mesh, long label) {
  freefem::Border result;
  std::map<int, std::int64_t> number;
  const auto node = [&](int vertex) {
    const auto found = number.emplace(vertex, static_cast<std::int64_t>(number.size()));
    if (found.second) {
      result.vertices.push_back(vertex);
      result.start.push_back(mesh(vertex).x), result.start.push_back(mesh(vertex).y);
    }
    return found.first->second;
  };
  for (int i = 0; i < mesh.neb; ++i) {
    if (mesh.be(i).lab != label) continue;
    int across = 0;
    const int triangle = mesh.BoundaryElement(i, across);
    // An edge of a triangle runs counterclockwise, with the body to its left.
    const int a = mesh(triangle, (across + 1) % 3), b = mesh(triangle, (across + 2) % 3);
    result.edges.push_back(node(b)), result.edges.push_back(node(a));
  }
  if (result.edges.empty())
    throw std::runtime_error("the mesh has no border with label " + std::to_string(label));
  return result;
}

class Make : public E_F0mps {
public:
  explicit Make(const basicAC_F0& args)
      : variable_(to<EntsContact*>(args[0])), mesh_(to<pmesh>(args[1])), slave_(to<long>(args[2])),
        master_(to<long>(args[3])), model_(to<string*>(args[4])) {
    args.SetNameParam(names, name_param, named_);
  }
  AnyType operator()(Stack stack) const override {
    EntsContact* variable = GetAny<EntsContact*>((*variable_)(stack));
    const Fem2D::Mesh* mesh = GetAny<pmesh>((*mesh_)(stack));
    const long slave = GetAny<long>((*slave_)(stack)), master = GetAny<long>((*master_)(stack));
    freefem::Options options;
    options.coordinate = static_cast<int>(value(0, stack, -1L));
    options.reach = value(1, stack, 0.);
    options.thickness = value(2, stack, 1.);
    options.ends = value(3, stack, false) ? ENTS_ENDS_STRAIGHT : ENTS_ENDS_REPEATED;
    options.ends = static_cast<int>(value(4, stack, long{options.ends}));
    const string model = *GetAny<string*>((*model_)(stack));
    variable->contact = checked([&] {
      return new BorderContact(model, border(*mesh, slave), border(*mesh, master), mesh->nv, options);
    });
    return variable;
  }

private:
  template <class T> T value(int i, Stack stack, T otherwise) const {
    return named_[i] ? GetAny<T>((*named_[i])(stack)) : otherwise;
  }
  static constexpr int names = 5;
  static basicAC_F0::name_and_type name_param[names];
  Expression variable_, mesh_, slave_, master_, model_, named_[names];
};

basicAC_F0::name_and_type Make::name_param[] = {{"coordinate", &typeid(long)},
                                                {"reach", &typeid(double)},
                                                {"thickness", &typeid(double)},
                                                {"straightEnds", &typeid(bool)},
                                                {"ends", &typeid(long)}};

class Forces : public E_F0mps {
public:
  explicit Forces(const basicAC_F0& args)
      : variable_(to<EntsContact*>(args[0])), u_(to<KN<double>*>(args[1])), r_(to<KN<double>*>(args[2])),
        i_(to<KN<long>*>(args[3])), j_(to<KN<long>*>(args[4])), k_(to<KN<double>*>(args[5])) {
    args.SetNameParam(1, name_param, &dt_);
  }
  AnyType operator()(Stack stack) const override {
    EntsContact* variable = GetAny<EntsContact*>((*variable_)(stack));
    KN<double>&u = *GetAny<KN<double>*>((*u_)(stack)), &r = *GetAny<KN<double>*>((*r_)(stack));
    KN<long>&i = *GetAny<KN<long>*>((*i_)(stack)), &j = *GetAny<KN<long>*>((*j_)(stack));
    KN<double>& k = *GetAny<KN<double>*>((*k_)(stack));
    return checked([&] {
      BorderContact& contact = made(variable);
      contact.require_sizes(u.N(), r.N());
      const double dt = dt_ ? GetAny<double>((*dt_)(stack)) : 0;
      const freefem::Forces forces = contact.evaluate(&u[0], &r[0], dt);
      const auto n = static_cast<long>(forces.value.size());
      i.resize(n), j.resize(n), k.resize(n);
      for (long e = 0; e < n; ++e) i[e] = forces.row[e], j[e] = forces.column[e], k[e] = forces.value[e];
      if (!forces.message.empty()) cout << "  ents: " << forces.message << endl;
      return SetAny<double>(forces.step_factor);
    });
  }

private:
  static basicAC_F0::name_and_type name_param[1];
  Expression variable_, u_, r_, i_, j_, k_, dt_ = nullptr;
};

basicAC_F0::name_and_type Forces::name_param[] = {{"dt", &typeid(double)}};

/// The end of an increment.
template <void (BorderContact::*end)()> class End : public E_F0mps {
public:
  explicit End(const basicAC_F0& args) : variable_(to<EntsContact*>(args[0])) {}
  AnyType operator()(Stack stack) const override {
    EntsContact* variable = GetAny<EntsContact*>((*variable_)(stack));
    checked([&] {
      (made(variable).*end)();
      return 0;
    });
    return SetAny<long>(0L);
  }

private:
  Expression variable_;
};

template <class Code, class Result, class... Arguments> class Function : public OneOperator {
public:
  Function() : OneOperator(atype<Result>(), atype<Arguments>()...) {}
  E_F0* code(const basicAC_F0& args) const override { return new Code(args); }
};

void load() {
  Dcl_Type<EntsContact*>(InitP<EntsContact>, Destroy<EntsContact>);
  zzzfff->Add("EntsContact", atype<EntsContact*>());
  TheOperators->Add("<-", new Function<Make, EntsContact*, EntsContact*, pmesh, long, long, string*>);
  Global.Add("entsForces", "(",
             new Function<Forces, double, EntsContact*, KN<double>*, KN<double>*, KN<long>*, KN<long>*,
                          KN<double>*>);
  Global.Add("entsAccept", "(", new Function<End<&BorderContact::accept>, long, EntsContact*>);
  Global.Add("entsReject", "(", new Function<End<&BorderContact::reject>, long, EntsContact*>);
}

} // namespace

LOADFUNC(load)
