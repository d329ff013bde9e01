!     SPDX-License-Identifier: BSD-3-Clause
!     FEAP and FEAPpv: contact element of ents, MATErial type user 7.
!     It goes to FEAP's user folder; another number NN: rename it.

      subroutine elmt07(d,ul,xl,ix,tl,s,p,ndf,ndm,nst,isw)

      use, intrinsic :: iso_c_binding
      use, intrinsic :: iso_fortran_env, only : output_unit
      implicit none

      include 'cdata.h'
      include 'eldata.h'
      include 'eltran.h'
      include 'hdata.h'
      include 'comblk.h'

      integer       :: ndf,ndm,nst,isw, ix(*)
      real (kind=8) :: d(*),ul(ndf,nen,*),xl(ndm,nen),tl(*)
      real (kind=8) :: s(nst,nst),p(ndf,nen)

      integer, parameter   :: width = 480
      character (len=width) :: text
      logical               :: errck, pinput
      integer (c_int)       :: status, words, want
      integer (kind=8)      :: i

      interface
        integer (c_int) function ents_feap_check(d,nodes,ndf,ndm,words,
     &                           text,length) bind(c)
          import :: c_int, c_double, c_char
          real (c_double)           :: d(*)
          integer (c_int), value    :: nodes,ndf,ndm,length
          integer (c_int)           :: words
          character (kind=c_char)   :: text(*)
        end function
        integer (c_int) function ents_feap_form(d,xl,ul,du,number,
     &              nodes,ndf,ndm,nst,want,factor,start,end,words,
     &              s,p,text,length) bind(c)
          import :: c_int, c_double, c_char
          real (c_double)           :: d(*),xl(*),ul(*),du(*)
          real (c_double)           :: start(*),end(*)
          real (c_double)           :: s(*),p(*)
          integer (c_int), value    :: number,nodes,ndf,ndm,nst,want
          integer (c_int), value    :: words,length
          real (c_double), value    :: factor
          character (kind=c_char)   :: text(*)
        end function
        integer (c_int) function ents_feap_step_end(number,text,
     &                           length) bind(c)
          import :: c_int, c_char
          integer (c_int), value    :: number,length
          character (kind=c_char)   :: text(*)
        end function
      end interface

      status = 0
      if(isw.eq.1) then
        errck  = pinput(d,3)
        status = ents_feap_check(d,nen,ndf,ndm,words,text,width)
        nh1    = words
        nh3    = 0
        pstyp  = 0
        d(4)   = words
      elseif(isw.eq.3 .or. isw.eq.6) then
        want   = 0
        if(isw.eq.3) want = 1
        words  = nint(d(4))
!       ul(:,:,2): u - u_n
        status = ents_feap_form(d,xl,ul,ul(1,1,2),n_el,nel,ndf,ndm,
     &           nst,want,ctan(1),hr(nh1),hr(nh2),words,s,p,text,width)
      elseif(isw.eq.12) then
        status = ents_feap_step_end(n_el,text,width)
      elseif(isw.eq.14) then
        do i = 0,nint(d(4))-1
          hr(nh1+i) = 0.0d0
          hr(nh2+i) = 0.0d0
        end do
      endif

      if(status.ne.0) then
        write(*,'(1x,a)') trim(text)
        flush(output_unit)
      endif
      if(status.eq.1) call plstop(.true.)

      end subroutine elmt07
