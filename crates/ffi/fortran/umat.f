C     Laws of Piola as a user material of Abaqus/Standard: elastic laws,
C     and laws with history (library with its feature `history`).
C
C     *MATERIAL, NAME=COMPRESSIBLE-GENT-SIMO_TAYLOR
C     *USER MATERIAL, CONSTANTS=3
C     1.0E6, 50.0, 1.0E9
C
C     *MATERIAL, NAME=REESE_GOVINDJEE-NEO_HOOKEAN-LAME-HENCKY-LAME
C     *USER MATERIAL, CONSTANTS=6, UNSYMM
C     1.0E6, 1.0E9, 2.0E6, 1.0E9, 5.0E5, 0.0
C     *DEPVAR
C     9
C
C     The name is that of a law and of its parts, with their parameters
C     as constants, or that of a file in the folder PIOLA_MATERIALS,
C     without constants.
C     STRESS is the Cauchy stress and DDSDDE the tangent of Jaumann's
C     rate of the Kirchhoff stress over J: 11, 22, 33, 12, 13, 23.
C     Solid elements, plane strain and axisymmetric elements (NDI = 3).
C
C     Laws with history: DEPVAR is the number of internal variables, as
C     piola_history_state_length_of gives it. A state of zeros is that
C     of the body as it was made. DDSDDE is consistent and not symmetric
C     in general. Elastic laws need no DEPVAR and leave STATEV alone.
C     The law THERMAL takes TEMP + DTEMP as its temperature at the end of
C     the increment and keeps it in STATEV(1). Give initial temperatures
C     (*INITIAL CONDITIONS, TYPE=TEMPERATURE): without them Abaqus begins
C     at 0, and a reference temperature other than 0 makes a strain.
C     Other laws do not depend on the temperature.
C     The growth of GIVEN_GROWTH is STATEV: write it in SDVINI, or here
C     before the call.
C
C     An increment without an answer asks for a smaller one, its reason
C     is printed, and STATEV stays as it was. What else is wrong is
C     printed, too, and the analysis ends.
C
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
      USE, INTRINSIC :: ISO_C_BINDING
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),
     1 DDSDDE(NTENS,NTENS),DDSDDT(NTENS),DRPLDE(NTENS),
     2 STRAN(NTENS),DSTRAN(NTENS),TIME(2),PREDEF(1),DPRED(1),
     3 PROPS(NPROPS),COORDS(3),DROT(3,3),DFGRD0(3,3),DFGRD1(3,3),
     4 JSTEP(4)
      INTERFACE
        INTEGER(C_INT) FUNCTION PIOLA_UMAT(NAME,NAMELEN,PROPS,NPROPS,
     1   NDI,NSHR,F0,F1,DT,HEAT,STATE,NSTATE,STRESS,TANGENT)
     2   BIND(C,NAME='piola_umat')
          USE, INTRINSIC :: ISO_C_BINDING
          IMPLICIT NONE
          CHARACTER(KIND=C_CHAR), INTENT(IN) :: NAME(*)
          INTEGER(C_SIZE_T), VALUE :: NAMELEN, NPROPS, NDI, NSHR
          INTEGER(C_SIZE_T), VALUE :: NSTATE
          REAL(C_DOUBLE), INTENT(IN) :: PROPS(*), F0(*), F1(*)
          REAL(C_DOUBLE), VALUE :: DT, HEAT
          REAL(C_DOUBLE), INTENT(INOUT) :: STATE(*)
          REAL(C_DOUBLE), INTENT(INOUT) :: STRESS(*), TANGENT(*)
        END FUNCTION
        INTEGER(C_SIZE_T) FUNCTION PIOLA_MESSAGE(TEXT,LENGTH)
     1   BIND(C,NAME='piola_last_error_padded')
          USE, INTRINSIC :: ISO_C_BINDING
          IMPLICIT NONE
          CHARACTER(KIND=C_CHAR), INTENT(OUT) :: TEXT(*)
          INTEGER(C_SIZE_T), VALUE :: LENGTH
        END FUNCTION
      END INTERFACE
      INTEGER(C_INT) ISTATUS
      INTEGER(C_SIZE_T) LENGTH
      CHARACTER(LEN=480) MESSAGE
      ISTATUS = PIOLA_UMAT(CMNAME, INT(LEN(CMNAME),C_SIZE_T),
     1 PROPS, INT(NPROPS,C_SIZE_T), INT(NDI,C_SIZE_T),
     2 INT(NSHR,C_SIZE_T), DFGRD0, DFGRD1, DTIME,
     3 TEMP+DTEMP, STATEV, INT(NSTATV,C_SIZE_T), STRESS, DDSDDE)
      IF (ISTATUS .EQ. 0) RETURN
      LENGTH = PIOLA_MESSAGE(MESSAGE, INT(LEN(MESSAGE),C_SIZE_T))
      WRITE(*,*) 'UMAT, element ', NOEL, ', point ', NPT, ': ',
     1 TRIM(MESSAGE)
      IF (ISTATUS .EQ. 6) THEN
        PNEWDT = 0.25D0
        RETURN
      END IF
      CALL XIT
      END
