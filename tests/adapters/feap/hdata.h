      integer (kind=8) :: nh1,nh2,nh3,ht1,ht2,ht3
      integer          :: nlm
      common /hdata/      nh1,nh2,nh3,ht1,ht2,ht3,nlm
