"""Words of the shipped crews whose slips were looked up, and slips among them that may be another word.

Made by tests/unit/contracts/language/make_slips.py; not to be edited.
"""

from crew.contracts.language.words import word_set

LOOKED_UP: frozenset[str] = word_set(
    """
    abort aborted aborting aborts across advance advanced advances advancing aerial after afterward afterwards
    airborne aircraft aircrafts aloft along amble ambled ambles ambling android androids area arm around ascend
    ascended ascending ascends asks askses attend attended attending attends aunt auntie aunties aunts back base bay
    bear bearing bears beside block bloke blokes bore borne bot bots bottle boy boys bring bringing brings brother
    brothers brought buggies buggy bye came camper campers can cancel canceled canceling cancels canned canning cans
    canvass canvassed canvasses canvassing car carried carries carry carrying cars casualties casualty cease ceased
    ceases ceasing chap chaps charger charging check checked checking checks child children childs chopper choppers
    climb climbed climber climbers climbing climbs colleague colleagues comb combed combing combs come comes coming
    convey conveyance conveyed conveying conveys coordinates coordinatesed coordinateses coordinatesing copter copters
    could coulded coulding coulds cousin cousins cover covered covering covers cube dad daddies daddy dads daughter
    daughters deliver delivered delivering delivers delivery deploy deployed deploying deploys descend descended
    descending descends desist desisted desisting desists despatch despatched despatches despatching detect detected
    detecting detects direct directed directing directs discover discovered discovering discovers dispatch dispatched
    dispatches dispatching dock dog doggie doggies doggo doggoes doggy dogs down drive driven drives driving droid
    droids drone drones drop dropoff dropped dropping drops drove east eastern easthalf end ended ending ends enter
    entered entering enters everything everywhere explore explored explores exploring father fathers fellow fellows
    fetch fetched fetches fetching field finally find finding finds first flew flies flown fly flyer flyers flying for
    found freeze freezes freezing friend friends from froze frozen gave gentleman gentlemans get gets getting girl
    girls give given gives giving goes going gone goodbye got gotten grab grabbed grabbing grabs grandad grandads
    granddad granddads granddaughter granddaughters grandfather grandfathers grandma grandmas grandmother grandmothers
    grandpa grandpas grandson grandsons grannies granny grasp grasped grasping grasps greet greeted greeting greets
    ground guy guys half halt halted halting halts hand handed handing hands hang hanged hanging hangs haul hauled
    hauling hauls have haved haves having head headed heading heads held helicopter helicopters hello her here heres
    hiker hikers him his hold holding holds home hound hounds hover hovered hovering hovers humanoid humanoids hunt
    hunted hunting hunts husband husbands injured inside inspect inspected inspecting inspects into iris its jogger
    joggers keep keeped keeping keeps kid kids ladies lady land landed landing lands later launch launched launches
    launching lay layed laying lays lift lifted lifting lifts like liked likes liking load loaded loading loads locate
    located locates locating location look looked looking looks machine machines make maked makes making man mans may
    mayed maying mays men mes might mighted mighting mights missing mission mom mommies mommy moms mother mothers move
    moved moves moving multicopter multicopters mum mummies mummy mums myself myselfs navigate navigated navigates
    navigating near need needed needing needs neighbour neighbours nephew nephews next niece nieces north northern
    northhalf off once onto operation operational operationalarea operator operators other out over pad part pass
    passed passes passing patient patients payload payloadtray people person persons pick picked picking picks pickup
    pinpoint pinpointed pinpointing pinpoints place placed places placing point pooch pooches pop popped popping pops
    portion position positioned positioning positions proceed proceeded proceeding proceeds pup puppies puppy pups put
    puts putting quad quadcopter quadcopters quadrocopter quadrocopters quadrotor quadrotors quadruped quadrupedal
    quadrupeds quads recall recalled recalling recalls recon reconnaissance reconnoiter reconnoitered reconnoitering
    reconnoiters reconnoitre reconnoitred reconnoitres reconnoitring red redcube redeploy redeployed redeploying
    redeploys redirect redirected redirecting redirects region relocate relocated relocates relocating relocation
    report reported reporting reports reposition repositioned repositioning repositions requester requesters reroute
    rerouted reroutes rerouting respond responded responding responds return returned returning returns right robodog
    robodogs robot robots room rooma roomb round route routed routes routing rover rovers run runned runner runners
    running runs say sayed saying says scan scanned scanning scans scour scoured scouring scours search searched
    searches searching second section sector seek seeking seeks seize seized seizes seizing send sending sends sent
    set sets setted setting shift shifted shifting shifts side sister sisters site son sons sought south southern
    southhalf spot stand standed standing stands start starting station still stop stopped stopping stops subsequently
    survey surveyed surveying surveys survivor survivors sweep sweeping sweeps swept table tablea tableb take taken
    takeoff takeoffed takeoffing takeoffs takes taking tell telling tells the their them then there they through
    throughout told took touch touched touches touching toward towards track tracked tracking tracks transfer
    transfered transfering transfers transport transportation transported transporting transports travel traveled
    traveling travels tray trot trots trotted trotting trouble trundle trundled trundles trundling turtlebot
    turtlebots uav uavs ugv ugvs uncle uncles unit units uses using vehicle vehicles via victim victims walk walked
    walker walkers walking walks want wanted wanting wants water wave waved waves waving way went west western
    westhalf wheeled when where who whoever whole wife wifes with within woman womans women you your zone
    """
)

DOUBTFUL: frozenset[str] = word_set(
    """
    abck able ables abling abor abors abort abortin abot abots abrt abse aby acme acn acr acrs add adds advance aeral
    afte afterward aftter agve aircraft aks alng alof alon alot alter aly alying ambe ambel amble amle amles amn amr
    amy android ant anties ants aong aort aound aprt apss ara are arial ascen ascend ascendd ask askes askss ass asses
    assk asy ater atken atten attend attendd attende attned aun auns aunt auntie aut auts awy baack baase bac bae baer
    baers baes bak bar baring bars bas basse bck bea beaing bear bearr bearrs beas beide ber beraing bering bers besie
    bey bggies bggy bing binging bings blck blke bllock bloc blok bloke bloks bock boe boer boke bone bonre boots bor
    bore boren born borre bos bost bosy bot bother bothers bought boy bre brig briging brigs briing brin bring brins
    brne broe brone brothe brother brothes brough brring bse bts bttle bugg bugges bys cacel cae cam camer camers
    campe camper can cance cancel cancelled cancelling cances caned canel caning caninng canne cannig canns canvas
    canvased canvases canvasess canvasing canvasse canvasss cap caper capers caps car caries carr carred carres carrie
    carring carrs carss cary cas case cased cases casing casualy causalty ceaes cease ceasse cha chager chaging chap
    chapp charer charge chargin charing chas chck chcked chcking chcks check checke checkeed chek cheks chid chil
    child chilld chils choppe chopper chp chpper chps cliber clibers clim climb climbe climber climed climing clims
    clmber cme cna cnned cnning cns cob cobs coe coer coered coering coers coes coing cold colds colleague colud
    coluded coluding coluds com comb combe combiing combin combinng come comed coming comme commes coms coney coneys
    conve conveed conveing convey conveye convy convys coomb coordinate coordinateed coordinatees coordinatess coper
    copers copper coppers copter cosin coter coud couded couding couds could couldd couled couling couls cousin cove
    coveed coveing cover coves covey coveys cra cras crried crries crry crrying cub cue cvers dad dadd dadies dady das
    daughter dck dda dds deect deected deecting deects deist deists deliveer deliver delivere deliverr delver delvers
    deploy deply descen descend descendd desised desising desisst desist desits despatche detect detectin detet
    deteted detets dgo dgos dgs direct directin diret direts discoveer discover discovere discoverr dispatche dive
    dives diving doc dog dogg dogge dogges doggie doggoe dogie dogies dogy dok don done dop dopped dopping dops dorp
    dos dove dow drid drids drie drien dries drive dro droe droes droi droid drois dron drone drons droop droopping
    droops drop droping droppe dros drp drpped drpping drps drve drves dspatch dspatched dspatches dspatching dwn eas
    easter eat eats ecase ecased ecasing eded eding edn edns eds ems end endd ened ens enter entere entr entre entres
    esat est ests eter eters exploe exploed exploer exploers exploes exploing explore explorre explorres expored
    exporing fater faters father feeze feld fellow fetche few fid fids fied fiedl fiel fieldd fiend fiends fies fild
    filed files fin finall find fining fins firs firsst firt firts fist fle fler flers fles flie fling flis fllies
    fllow fllows flon flow flw flyer fnd fnding fnds fom fond form foun foundd fown freee freees freeing freeze freze
    fried friend frined frm fro froe froen fromm froze frst ftch fund fyer fyers fying gaave gab gabbed gabbing gabs
    gae garb garbs gasp gasped gasping gasps geet geets gentleman gentlemn geos geret gerets ges gest get gie gies gil
    gils gir girl girll girlls girs give gne gnoe goe goin gon gong goodby gooes gooing gos gose gra grab grabb grabbe
    granad granda grandad grandadd grandads grandam grandams grandas grandd grandda granddad granddadd granddads
    granddaughter grandds grandfather grandma grandmother grandpa grandpaa grandppa grandson grann grannie grany grap
    graping graps gras grased grasing grasp grass grassp grb grbbing grbs gree greeed greeing grees greet greete gret
    grets gril grils groundd grund gte gtes gts gtting gus gusy guv guvs guy gve gys had haded hading hadn hads hae
    haed haeds haes hag hagn hags haing hal haled haling hals halt halte han hand handd hande haned hang hange haning
    hans hat hated hating hats hau haul haule haus have hea head headd heade heaed heaing heas hed heded heding heds
    hee heeld heer heers hees hel helicopter hell her here heress hers herse hier hiers hike hiker hikes hld hled hllo
    hlt hlts hme hnd hnds hng hnged hnt hnted hnting hnts hod hods hoe hoer hoers hol hold holing hols hom hond hoover
    hoovered hoovering hoovers hound houndd hove hover hoves hre hres hte hual hul huled huling huls humanoid hun huns
    hunt hunte husband hut huting huts hve hvering hves hwen hwo hwoever iis inide injure ino inot insect insects
    inspect inspectin int inured iriss irs ist ito iva jgger jogge jogger kee keeed keeing keep keepe kees kep kid kis
    lad laddies laded lades ladie lading ladn lads laed laer laing lan land landd lande laned laning lans las late
    latter launces launche lay layd laye layeed lfit lfits lft lfts lie lied lies lif lift lifte liing lik like likeed
    liks lit lited liting lits lke lkes lland lnd lnding lnds loa load loadd loade loaed loaing loas loate loated
    loates loating locae locaes locate locatin lod loded loding lods lok loked loking loks loo looed looing look looke
    loos lter lunch lunched lunches lunching lya lying maans mable mabled mables mabling machine mae maed maes maing
    mak make maks man mas masn may maye might mising missin mke mkes mmmies mmmy mmo mmos mms mmu mmus mna mnas mne
    mns moe moed moes moing mom momm mos mother move mse mssing mther mum mumm mus mya mys myself naer nar navigate
    navigatin nea nearr ned neded neding neds nee need needd neede neeed neighbor neighbors neighbour nephew ner net
    neter netered netering nice nicee nices niec niece nito noce northen norther noth nucle nucles obt obts oby obys
    ocne oer oges oging omm omms one onnce ono ont operatin operationall operator opp opps oter oto otward otwards ove
    ozne paart pace paced paces pacing palce palces par parrt partt pas pased pases pasing passe passin passs passse
    pat patent patents patient payloa pck pcked pcking pcks peerson peron person peson pic piced picing pick picke
    pickeed pics pik piked piking piks pinpoint pint piont plaace plaaces placd place plae plaed plaes plaing poch
    poches poin poit pooc pooh poopped poopping poops pop poped poping poppe poppin popps portin porton pos positin
    position positon potion ppo ppos pppies pppy pps ppu ppups ppus prat prceeded prceeding preson proceed proceedd
    proceeed prson prsons prt psas psot pss pssed psses pssing pts ptting pup pupp puppes puppis pus put puting puttin
    putts qua quad quadrupe quadruped quas qud quds ram rboot rboots rde rdone reall realls recal recall reconnoite
    reconnoiter reconnoiters reconnoitr reconnoitre redcue redeploy redirect redirectin regin rellocation relocate
    relocatin reocation reon reort reorted reorting reorts repor report reporte reposition requeste requester rerote
    reroute resond resonded resonding resonds respond respondd responde respons retun retuning return reurn reurns
    robot robt roer roers rom roma romo rond roo rooam roob room root roots rote roted roting roue roued roues rouing
    roun roundd rout route routin routs rove rover roves rroute rrouted rroutes rrouting rruns run runed runing runne
    runner runnes rus ruted ruting rver rvers saed saing saks san sand sanded sanding sands sanned sanning sans sarch
    sarched sart sarting sas sasy say sca scan scanne scas scor scored scoring scors scou scoued scouing scour scoure
    scous sction scured scuring sde sdie searche secondd sed seding sedn sedns seds see seection seector seeing seek
    seep seeping seeps sees seets seie seies seize seizin sen send sening sens sensd sept ses set seted seting setn
    sette setts shft shfted shfting shfts shift shifte shit shited shiting shits sid sidde sie sied sift sifted
    sifting sifts siister siite sill sister sit siter siters sitte size sized sizes sizing snd snding snds sno snos
    sns snt son soons sop sopped sopping sops sos sot soth sough souht sour soured souring sours sout souther spo
    spott spt stad stan stand standd staned staning stans star staring stat statin stating staton ste stes stie stil
    stll sto stoop stoopped stoopping stoops stop stoped stoping stoppe stp stpped stpping stps strat strt sts stted
    stting sues suing surey survey survivor survy swee sweep swees swep swet sya sying sys taable tabl tabla table
    tack tacked tacking tacks tae taek taen taes taing tak take takeoff takin takn taks tale tary tavel teh teir tel
    tell tels tem ten tere tey the thee theem ther theree thir thme thn thne thorugh though thre three throough
    throughut thy thye tis tke tken tkes tking tld tll tlling tlls toch toched toches toching tod tok toko tol tolld
    too toold tort torts tot tots totted totting touche touh toward tra trac traced tracing track tracke tracs
    transfer transfere transferr transferred transferring transport transporte trave travel travele travelled
    travelling traves trck trcked trcking trcks tro tros trot trotte trough trt trts trundle try uas ues ugs ugv ugy
    umm uncle uni unis unit unles unt unti unts upp upps urn urns use usng uss usse vai vehicle veicle veicles victim
    vitim voer wae waed waer waes waing waivng wak waked waker wakers waking wakling waks wal waled waler walers
    waling walk walke walker walkes wals wan waned waning wans want wat wate wated wating watr wats wav wave waveed
    waviing weest wen were wes wester wet wets whe whee wheelde wheele wheen whle whne whoe whooever whre wie wies wif
    wife wih wiht wit wnt wnted woen wole woman womn wooman wst wve wves yor you yuo yur zne zoe zon zoone
    """
)
