#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Teach the sources of ccx 2.20 the elements U1E and U1A of libents_calculix.so.

usage: patch.py CCX_SOURCES OUT

Writes the eleven changed files to OUT. ccx itself is not part of this project (GPL); its files are read from CCX_SOURCES, the folder
with ccx_2.20.c. Every place that is changed must be there exactly once: another version of ccx is refused, not damaged."""
import pathlib
import sys

# file: [(text that must be there once, text that takes its place)]
PATCHES = {
    # stiffness pass
    "e_c3d_u.f": [(
        "      if(lakonl(2:2).eq.'1') then\n        call e_c3d_u1(",
        "      if((lakonl(2:3).eq.'1E').or.(lakonl(2:3).eq.'1A')) then\n"
        "        call ents_ccx_stiffness(nelem,lakonl,s,sm,ff)\n"
        "      elseif(lakonl(2:2).eq.'1') then\n        call e_c3d_u1(")],
    # Force pass. Where forced displacements go on, ccx begins an increment with a linear one (iperturb(1) = -1): what is wanted then is the
    # stiffness at vold, where the last increment ended, times v - vold. `ento` is zero: neither forces nor their mean are wanted at vold.
    "resultsmech_u.f": [(
        "     &  calcul_cauchy,calcul_qa,nelem\n",
        "     &  calcul_cauchy,calcul_qa,nelem,ento\n"), (
        "      if(lakon(nelem)(2:2).eq.'1') then\n",
        "      ento=0\n"
        "      if((nmethod.eq.2).and.((lakon(nelem)(2:3).eq.'1E').or.\n"
        "     &     (lakon(nelem)(2:3).eq.'1A')))\n"
        "     &     call ents_ccx_linear_step(nelem,lakon(nelem))\n"
        "      if((iperturb(1).eq.-1).and.((lakon(nelem)(2:3).eq.'1E').or.\n"
        "     &     (lakon(nelem)(2:3).eq.'1A'))) then\n"
        "         if(lakon(nelem)(2:3).eq.'1E') then\n"
        "            call ents_ccx_force(nelem,kon,ipkon,lakon(nelem),co,vold,\n"
        "     &           vini,mi,ielprop,prop,fn,qa,nal,ento,ento,\n"
        "     &           xstateini,xstate,nstate_,dtime)\n"
        "         else\n"
        "            call ents_ccx_uel_force(nelem,kon,ipkon,lakon(nelem),co,\n"
        "     &           vold,vini,mi,ielprop,prop,fn,qa,nal,ento,ento,\n"
        "     &           xstateini,xstate,nstate_,time,ttime,dtime,istep,iinc)\n"
        "         endif\n"
        "         call ents_ccx_linear_force(nelem,kon,ipkon,lakon(nelem),vold,\n"
        "     &        v,mi,fn,calcul_fn)\n"
        "      elseif(lakon(nelem)(2:3).eq.'1E') then\n"
        "         call ents_ccx_force(nelem,kon,ipkon,lakon(nelem),co,v,\n"
        "     &        vini,mi,ielprop,prop,fn,qa,nal,calcul_fn,calcul_qa,\n"
        "     &        xstateini,xstate,nstate_,dtime)\n"
        "      elseif(lakon(nelem)(2:3).eq.'1A') then\n"
        "         call ents_ccx_uel_force(nelem,kon,ipkon,lakon(nelem),co,v,\n"
        "     &        vini,mi,ielprop,prop,fn,qa,nal,calcul_fn,calcul_qa,\n"
        "     &        xstateini,xstate,nstate_,time,ttime,dtime,istep,iinc)\n"
        "      elseif(lakon(nelem)(2:2).eq.'1') then\n")],
    # with the unsymmetric solver the elements are assembled by mafillsmas, as ccx does with its own frictional contact
    "mafillsm.f": [(
        "            ndof=ichar(lakon(i)(7:7))\n            nope=ichar(lakon(i)(8:8))\n          else\n            cycle\n"
        "          endif\n!     \nc     mortar start\n",
        "            if((nasym.eq.1).and.((lakon(i)(1:3).eq.'U1E').or.\n"
        "     &           (lakon(i)(1:3).eq.'U1A'))) cycle\n"
        "            ndof=ichar(lakon(i)(7:7))\n            nope=ichar(lakon(i)(8:8))\n          else\n            cycle\n"
        "          endif\n!     \nc     mortar start\n"), (
        # stiffness pass of temperatures; nope = 0: an element without heat
        "          elseif((lakon(i)(1:1).eq.'E').and.(lakon(i)(7:7).ne.'A')) then\n",
        "          elseif(lakon(i)(1:3).eq.'U1E') then\n"
        "            call ents_ccx_heat_stiffness(i,nope,s,sm,ff)\n"
        "            if(nope.eq.0) cycle\n"
        "          elseif((lakon(i)(1:1).eq.'E').and.(lakon(i)(7:7).ne.'A')) then\n"), (
        "          call e_c3d_th(",
        "          if(lakon(i)(1:3).ne.'U1E')\n     &         call e_c3d_th(")],
    # Force pass of temperatures. Elements with heat alone have some: their nodes may be those of no solid, and a row of zeros is singular.
    "resultstherm.f": [(
        "         if(lakon(i)(4:5).eq.'20') then\n            nope=20\n",
        "         if(lakon(i)(1:3).eq.'U1E') then\n"
        "            call ents_ccx_heat_force(i,kon,ipkon,lakon(i),co,v,mi,\n"
        "     &           ielprop,prop,fn,qa,nal,calcul_fn,calcul_qa,xstateini,\n"
        "     &           nstate_,dtime,ithermal,nmethod)\n"
        "            cycle\n"
        "         elseif(lakon(i)(4:5).eq.'20') then\n            nope=20\n")],
    "mastruct.c": [
        ("\telse if (strcmp1(&lakon[8*i+3],\"6\")==0)nope=6;\n",
         "\telse if((strcmp1(&lakon[8*i],\"U1E\")==0)&&ents_ccx_has_heat_(&i))nope=lakon[8*i+7];\n"
         "\telse if (strcmp1(&lakon[8*i+3],\"6\")==0)nope=6;\n"),
        ("      else if (strcmp1(&lakon[8*i+3],\"6\")==0)nope=6;\n",
         "      else if((strcmp1(&lakon[8*i],\"U1E\")==0)&&ents_ccx_has_heat_(&i))nope=lakon[8*i+7];\n"
         "      else if (strcmp1(&lakon[8*i+3],\"6\")==0)nope=6;\n"),
        ("void mastruct(ITG *nk,", "extern ITG ents_ccx_has_heat_(ITG *);\n\nvoid mastruct(ITG *nk,")],
    "mafillsmas.f": [
        ("          if(lakon(i)(1:2).ne.'ES') cycle\n",
         "          if((lakon(i)(1:3).eq.'U1E').or.\n"
         "     &       (lakon(i)(1:3).eq.'U1A')) then\n"
         "            indexe=ipkon(i)\n"
         "            nope=ichar(lakon(i)(8:8))\n"
         "            call ents_ccx_stiffness(i,lakon(i),s,sm,ff)\n"
         "          else\n"
         "          if(lakon(i)(1:2).ne.'ES') cycle\n"),
        ("     &         set,nset,islavelinv,autloc1,irowtloc1,jqtloc1,\n"
         "     &         mortartrafoflag)\n!     \n          do jj=1,3*nope\n",
         "     &         set,nset,islavelinv,autloc1,irowtloc1,jqtloc1,\n"
         "     &         mortartrafoflag)\n          endif\n!     \n          do jj=1,3*nope\n")],
    # ... which looks at all elements then, not only at those of contact pairs
    "mafillsmasmain.c": [(
        "  if(nec>0){\n",
        "  ITG ents=0;\n"
        "  for(i=0;i<*ne;i++){\n"
        "    if((ipkon[i]>=0)&&((strcmp1(&lakon[8*i],\"U1E\")==0)||(strcmp1(&lakon[8*i],\"U1A\")==0))) ents=1;\n"
        "  }\n"
        "  if(ents){\n    elementcpuload(neaparm,nebparm,ne,ipkon,&num_cpus);\n  }else if(nec>0){\n")],
    # A contact pair makes a step nonlinear (contactpairs.f: iterations, and strains as the step says); elements U1E and U1A do so, too.
    "calinput.f": [(
        "      elseif(textpart(1)(1:12).eq.'*USERELEMENT') then\n",
        "      elseif(textpart(1)(1:12).eq.'*USERELEMENT') then\n"
        "        do i=2,n\n"
        "          if(((textpart(i)(1:8).eq.'TYPE=U1E').or.\n"
        "     &         (textpart(i)(1:8).eq.'TYPE=U1A')).and.\n"
        "     &         (iperturb(1).eq.0)) iperturb(1)=2\n"
        "        enddo\n"), (
        # at the end of each step's lines: which elements have heat
        "      if(istep.eq.1) ncs_=lprev\n",
        "      if(ier.eq.0) call ents_ccx_find_heat(ne,ipkon,lakon,ielprop,prop,\n"
        "     &     nprop,ithermal)\n"
        "      if(istep.eq.1) ncs_=lprev\n")],
    # User elements are no shells or beams: without this one of them crashes a job with elements of one or two dimensions (CalculiX issue 170).
    "gen3delem.f": [(
        "     &         (lakon(i)(1:4).ne.'MASS')) then\n",
        "     &         (lakon(i)(1:1).ne.'U').and.\n"
        "     &         (lakon(i)(1:4).ne.'MASS')) then\n")],
    # Nodes of shells, beams and plane elements that U1E or U1A has, too, are tied to the solid that ccx makes of these, as for springs.
    "gen3dconnect.f": [
        ("         if((lakon(i)(7:7).ne.' ').and.(lakon(i)(1:1).ne.'E')) cycle\n",
         "         if((lakon(i)(7:7).ne.' ').and.(lakon(i)(1:1).ne.'E').and.\n"
         "     &      (lakon(i)(1:3).ne.'U1E').and.(lakon(i)(1:3).ne.'U1A')) cycle\n"),
        ("         if(lakon(i)(4:4).eq.'4') then\n            nope=4\n",
         "         if((lakon(i)(1:3).eq.'U1E').or.(lakon(i)(1:3).eq.'U1A')) then\n"
         "            nope=ichar(lakon(i)(8:8))\n"
         "         elseif(lakon(i)(4:4).eq.'4') then\n            nope=4\n")],
    "nonlingeo.c": [(
        "  if((*nstate_!=0)&&((*mortar!=1)||(ncont==0))){\n    NNEW(xstateini,",
        "  _Static_assert(sizeof(ITG)==4,\"libents_calculix has integers of 4 bytes: compile ccx without LONGLONG\");\n"
        "  extern ITG ents_ccx_unsymmetric_(ITG *,ITG *,char *,ITG *,double *,ITG *);\n"
        "  extern ITG ents_ccx_uel_unsymmetric_(ITG *,ITG *,char *,ITG *,double *);\n"
        "  ITG ents_unsymmetric=ents_ccx_unsymmetric_(ne,ipkon,lakon,ielprop,prop,nprop)||\n"
        "    ents_ccx_uel_unsymmetric_(ne,ipkon,lakon,ielprop,prop);\n"
        "  if(*ithermal==2) ents_unsymmetric=0; // temperatures alone\n"
        "  if(ents_unsymmetric) nasym=1;\n"
        "  ITG ents_elements=0;\n"
        "  for(i=0;i<*ne;i++){\n"
        "    if((ipkon[i]>=0)&&((strcmp1(&lakon[8*i],\"U1E\")==0)||(strcmp1(&lakon[8*i],\"U1A\")==0))) ents_elements=1;\n"
        "  }\n"
        "  if((*nstate_!=0)&&((*mortar!=1)||(ncont==0))){\n    NNEW(xstateini,"),
        # An increment starts where the last one ended, as ccx does after other discontinuities. From a state extrapolated along the sliding, nodes that stick start
        # slipping, and Newton's iteration throws them to and fro; and a body that contact alone holds may start free of it.
        ("    if (*mortar==-1){\n      memcpy(&v[0], &vold[0],",
         "    if(ents_elements) idiscon=1;\n    if (*mortar==-1){\n      memcpy(&v[0], &vold[0],"),
        # ... and with a linear iteration, as ccx begins a step: else a surface that is moved runs into nodes that are still where they were, these slip under
        # a pressure that is many times the real one, and are thrown to and fro
        # what has moved farther than its elements reach is noticed where an increment has converged
        ("    /* icutb=0 means that the iterations in the increment converged,\n",
         "    extern void ents_ccx_increment_end_(double *,double *,ITG *,ITG *,ITG *);\n"
         "    if(ents_elements&&(icutb==0)) ents_ccx_increment_end_(co,vold,mi,istep,&iinc);\n"
         "    /* icutb=0 means that the iterations in the increment converged,\n"),
        ("    if((iinc==1)&&(*ithermal<2)&&(*nmethod!=4)){\n",
         "    if((((iinc==1)&&(*ithermal<2))||(ents_unsymmetric&&(*ithermal!=2)))&&(*nmethod!=4)){\n"),
        # ... in coupled steps, too: forces are linear from the last temperatures, whose strains are in the forces there; powers are those at v
        ("      results(co,nk,kon,ipkon,lakon,ne,v,stn,inum,stx,\n"
         "\t      elcon,nelcon,rhcon,nrhcon,alcon,nalcon,alzero,ielmat,\n"
         "\t      ielorien,norien,orab,ntmat_,t1ini,t1act,ithermal,\n",
         "      double *ents_t=t1ini;\n"
         "      if(*ithermal>1){ents_t=NULL;NNEW(ents_t,double,*nk);for(k=0;k<*nk;++k) ents_t[k]=vold[mt*k];}\n"
         "      results(co,nk,kon,ipkon,lakon,ne,v,stn,inum,stx,\n"
         "\t      elcon,nelcon,rhcon,nrhcon,alcon,nalcon,alzero,ielmat,\n"
         "\t      ielorien,norien,orab,ntmat_,ents_t,t1act,ithermal,\n"),
        ("      iperturb[0]=0;if(ne1d2d==1)SFREE(inum);\n", "      if(*ithermal>1) SFREE(ents_t);\n      iperturb[0]=0;if(ne1d2d==1)SFREE(inum);\n"),
        ("      for(k=0;k<neq[1];++k){\n\tf[k]=f[k]+b[k];}\n", "      for(k=0;k<neq[0];++k){\n\tf[k]=f[k]+b[k];}\n")],
}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sources, out = map(pathlib.Path, sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    for name, changes in PATCHES.items():
        text = (sources / name).read_text(encoding="latin-1")
        for old, new in changes:
            if text.count(old) != 1:
                sys.exit(f"patch.py: {sources / name}: {text.count(old)} places instead of 1 read:\n{old}\nIs this ccx 2.20?")
            text = text.replace(old, new)
        (out / name).write_text(text, encoding="latin-1")
    print(f"patched: {', '.join(PATCHES)}")


main()
